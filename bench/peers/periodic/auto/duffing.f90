! Forced Duffing oscillator for AUTO-07p:
!
!   x'' + c x' + k x + g x^3 = P cos((base + detuning) t)
!
! case.inc, written by auto.py, gives the numbers as constants. States: x, x'/scale and the two
! states of an oscillator whose orbit is exactly (sin, cos) of the excitation's phase, which makes
! the equations autonomous, as AUTO's periodic orbits with Floquet multipliers must be. The
! frequency is continued as a detuning, since AUTO prints eleven digits of a parameter.
SUBROUTINE FUNC(NDIM, U, ICP, PAR, IJAC, F, DFDU, DFDP)
  IMPLICIT NONE
  INTEGER, INTENT(IN) :: NDIM, ICP(*), IJAC
  DOUBLE PRECISION, INTENT(IN) :: U(NDIM), PAR(*)
  DOUBLE PRECISION, INTENT(OUT) :: F(NDIM)
  DOUBLE PRECISION, INTENT(INOUT) :: DFDU(NDIM, NDIM), DFDP(NDIM, *)
  DOUBLE PRECISION :: x, y, s, c, w, r
  INCLUDE 'case.inc'

  x = U(1); y = U(2); s = U(3); c = U(4)
  w = base + PAR(1)
  r = s*s + c*c
  F(1) = scale*y
  F(2) = (PAR(2)*c - stiffness*x - cubic*x*x*x)/scale - damping*y
  F(3) = s + w*c - s*r
  F(4) = c - w*s - c*r
  IF (IJAC == 0) RETURN
  DFDU = 0D0
  DFDU(1, 2) = scale
  DFDU(2, 1) = -(stiffness + 3D0*cubic*x*x)/scale
  DFDU(2, 2) = -damping
  DFDU(2, 4) = PAR(2)/scale
  DFDU(3, 3) = 1D0 - r - 2D0*s*s
  DFDU(3, 4) = w - 2D0*s*c
  DFDU(4, 3) = -w - 2D0*s*c
  DFDU(4, 4) = 1D0 - r - 2D0*c*c
  IF (IJAC == 1) RETURN
  DFDP(:, 1:2) = 0D0
  DFDP(3, 1) = c
  DFDP(4, 1) = -s
  DFDP(2, 2) = c/scale
END SUBROUTINE FUNC

! The first orbit: the linear response, which is near enough away from the resonance.
SUBROUTINE STPNT(NDIM, U, PAR, T)
  IMPLICIT NONE
  INTEGER, INTENT(IN) :: NDIM
  DOUBLE PRECISION, INTENT(INOUT) :: U(NDIM), PAR(*)
  DOUBLE PRECISION, INTENT(IN) :: T
  DOUBLE PRECISION :: phase, w
  COMPLEX(8) :: x
  INCLUDE 'case.inc'

  PAR(1) = start
  PAR(2) = amplitude
  w = base + start
  PAR(11) = 2D0*ACOS(-1D0)/w
  phase = 2D0*ACOS(-1D0)*T
  x = amplitude/CMPLX(stiffness - w*w, damping*w, 8)*EXP(CMPLX(0D0, phase, 8))
  U(1) = REAL(x)
  U(2) = REAL(CMPLX(0D0, w, 8)*x)/scale
  U(3) = SIN(phase)
  U(4) = COS(phase)
END SUBROUTINE STPNT

SUBROUTINE BCND
END SUBROUTINE BCND

SUBROUTINE ICND
END SUBROUTINE ICND

SUBROUTINE FOPT
END SUBROUTINE FOPT

SUBROUTINE PVLS
END SUBROUTINE PVLS
