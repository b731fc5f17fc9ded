! Chain of inertias with a cubic law in every shaft, for AUTO-07p. The absorber case is such a
! chain too: two inertias of unlike size, a cubic ground shaft, the torque on the first.
!
!   m(i) x(i)'' + ground(i) x(i)' = h(i-1) - h(i) + torque(i) cos((base + detuning) t)
!   h(i) = stiffness(i) u + cubic(i) u^3 + damping(i) u',  u = x(i) - x(i+1), h(last) = 0,
!   and h(0) is the same with u = -x(1): shaft 0 goes from ground to the first inertia.
!
! case.inc, written by auto.py, gives the numbers as constants: n and the arrays. States: x, x'/scale
! and the oscillator that stands for the excitation's phase (see duffing.f90).
SUBROUTINE FUNC(NDIM, U, ICP, PAR, IJAC, F, DFDU, DFDP)
  IMPLICIT NONE
  INTEGER, INTENT(IN) :: NDIM, ICP(*), IJAC
  DOUBLE PRECISION, INTENT(IN) :: U(NDIM), PAR(*)
  DOUBLE PRECISION, INTENT(OUT) :: F(NDIM)
  DOUBLE PRECISION, INTENT(INOUT) :: DFDU(NDIM, NDIM), DFDP(NDIM, *)
  DOUBLE PRECISION :: s, c, w, r, twist, h, slope
  INTEGER :: i, j
  INCLUDE 'case.inc'

  s = U(2*n+1); c = U(2*n+2)
  w = base + PAR(1)
  r = s*s + c*c
  DO i = 1, n
     F(i) = scale*U(n+i)
     F(n+i) = PAR(2)*torque(i)*c/(scale*inertia(i)) - ground(i)/inertia(i)*U(n+i)
  END DO
  F(2*n+1) = s + w*c - s*r
  F(2*n+2) = c - w*s - c*r
  h = -(stiffness(0)*U(1) + cubic(0)*U(1)**3)/scale - damping(0)*U(n+1)
  F(n+1) = F(n+1) + h/inertia(1)
  DO i = 1, n-1
     twist = U(i) - U(i+1)
     h = (stiffness(i)*twist + cubic(i)*twist**3)/scale + damping(i)*(U(n+i) - U(n+i+1))
     F(n+i) = F(n+i) - h/inertia(i)
     F(n+i+1) = F(n+i+1) + h/inertia(i+1)
  END DO
  IF (IJAC == 0) RETURN
  DFDU = 0D0
  DO i = 1, n
     DFDU(i, n+i) = scale
     DFDU(n+i, n+i) = -ground(i)/inertia(i)
     DFDU(n+i, 2*n+2) = PAR(2)*torque(i)/(scale*inertia(i))
  END DO
  DFDU(2*n+1, 2*n+1) = 1D0 - r - 2D0*s*s
  DFDU(2*n+1, 2*n+2) = w - 2D0*s*c
  DFDU(2*n+2, 2*n+1) = -w - 2D0*s*c
  DFDU(2*n+2, 2*n+2) = 1D0 - r - 2D0*c*c
  DFDU(n+1, 1) = -(stiffness(0) + 3D0*cubic(0)*U(1)**2)/(scale*inertia(1))
  DFDU(n+1, n+1) = DFDU(n+1, n+1) - damping(0)/inertia(1)
  DO i = 1, n-1
     j = i + 1
     slope = (stiffness(i) + 3D0*cubic(i)*(U(i) - U(j))**2)/scale
     DFDU(n+i, i) = DFDU(n+i, i) - slope/inertia(i)
     DFDU(n+i, j) = DFDU(n+i, j) + slope/inertia(i)
     DFDU(n+j, i) = DFDU(n+j, i) + slope/inertia(j)
     DFDU(n+j, j) = DFDU(n+j, j) - slope/inertia(j)
     DFDU(n+i, n+i) = DFDU(n+i, n+i) - damping(i)/inertia(i)
     DFDU(n+i, n+j) = DFDU(n+i, n+j) + damping(i)/inertia(i)
     DFDU(n+j, n+i) = DFDU(n+j, n+i) + damping(i)/inertia(j)
     DFDU(n+j, n+j) = DFDU(n+j, n+j) - damping(i)/inertia(j)
  END DO
  IF (IJAC == 1) RETURN
  DFDP(:, 1:2) = 0D0
  DFDP(2*n+1, 1) = c
  DFDP(2*n+2, 1) = -s
  DO i = 1, n
     DFDP(n+i, 2) = torque(i)*c/(scale*inertia(i))
  END DO
END SUBROUTINE FUNC

! The first orbit: one harmonic, whose coefficients auto.py found for the linear chain.
SUBROUTINE STPNT(NDIM, U, PAR, T)
  IMPLICIT NONE
  INTEGER, INTENT(IN) :: NDIM
  DOUBLE PRECISION, INTENT(INOUT) :: U(NDIM), PAR(*)
  DOUBLE PRECISION, INTENT(IN) :: T
  DOUBLE PRECISION :: phase, w
  INTEGER :: i
  INCLUDE 'case.inc'

  PAR(1) = start
  PAR(2) = amplitude
  w = base + start
  PAR(11) = 2D0*ACOS(-1D0)/w
  phase = 2D0*ACOS(-1D0)*T
  DO i = 1, n
     U(i) = first_cosine(i)*COS(phase) + first_sine(i)*SIN(phase)
     U(n+i) = w/scale*(first_sine(i)*COS(phase) - first_cosine(i)*SIN(phase))
  END DO
  U(2*n+1) = SIN(phase)
  U(2*n+2) = COS(phase)
END SUBROUTINE STPNT

SUBROUTINE BCND
END SUBROUTINE BCND

SUBROUTINE ICND
END SUBROUTINE ICND

SUBROUTINE FOPT
END SUBROUTINE FOPT

SUBROUTINE PVLS
END SUBROUTINE PVLS
