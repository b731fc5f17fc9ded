"""The cases and their references: published examples, and values to ten digits."""

import math
from dataclasses import dataclass

from lines import Gear, Line, Shaft, Size, Torque, chain


@dataclass(frozen=True)
class Case:
    """One line with what is known of it.

    Frequencies are in Hz, rigid-body modes included as 0. `published` are as printed there.
    Eigenvalues (1/s) are those of the damped line, of each pair the one above the real axis.
    Torques are moduli over speed, shaft and order, or their sums over the orders; `elastic` is the part
    that the springs carry, where dampers beside them carry some too.
    """

    key: str
    title: str
    line: Line
    frequencies: tuple
    published: tuple = ()
    eigenvalues: tuple = ()
    torque: Torque | None = None
    torques: tuple = ()
    elastic: tuple = ()
    summed: bool = False
    scaled: bool = False
    known: float = 1e-9
    remark: str = ""


TWO = Case(
    "two", "Two discs on a shaft", chain((211.4, 8.3), (9.775e6,)),
    (0.0, 176.0767468), ("0", "176.1"))

FIVE = Case(
    "five", "Friswell, example 9.7.1: five discs",
    chain((0.0035, 0.0035, 0.0035, 0.15, 0.05), (12e3, 12e3, 14e3, 10e3)),
    (0.0, 81.20762902, 141.2140714, 378.9529539, 536.3632829),
    ("0", "81.21", "141.21", "378.95", "536.36"))


def steel(length, outer):
    """A massless solid shaft of the geared line."""
    return Size(length, outer, 0.0, 68e9, 0.0, 1)


GEARED = Case(
    "geared", "Friswell, 9.6.3: two geared branches, massless shafts by dimensions",
    Line(7, ((0, 3200.0), (1, 200.0), (2, 200.0), (3, 800.0), (4, 800.0), (5, 450.0), (6, 450.0)),
         (Shaft(0, 1, size=steel(2.5, 0.2)), Shaft(3, 5, size=steel(3.5, 0.25)),
          Shaft(4, 6, size=steel(3.5, 0.25))),
         (Gear(1, 2, 0.5, 0.5), Gear(1, 3, 0.5, 0.8), Gear(2, 4, 0.5, 0.8))),
    (0.0, 10.30419334, 20.47926065, 24.42291926), ("0", "10.304", "20.479", "24.423"))


def string(elements):
    """A hollow shaft of 800 m between two discs."""
    size = Size(800.0, 0.78, 0.65, 75e9, 8000.0, elements)
    return Line(2, ((0, 200.0), (1, 10.0)), (Shaft(0, 1, size=size),))


STRING = Case(
    "string", "Friswell, 9.9: hollow shaft of 800 m, five elements", string(5),
    (0.0, 1.941661739, 4.071920906, 6.543740886, 9.154726842, 10.52439056),
    ("0", "1.9417", "4.0719", "6.5437", "9.1547"))

FINE_STRING = Case(
    "fine-string", "The same shaft in 200 elements against the continuum", string(200),
    (0.0, 1.910332294, 3.820664759, 5.730997568, 7.641330893, 9.551664905), known=3e-4,
    remark="error of the elements: (5 π / 200)² / 24 = 2.6e-4")

GROUNDED = Case(
    "grounded", "Friswell, 9.6: nine discs, springs to ground at two of them",
    chain((90.0, 140.0, 140.0, 140.0, 140.0, 90.0, 350.0, 500.0, 22e3), (2.5e6,) * 5 + (4e7, 4e7, 3e6),
          ground_stiffness=((0, 1e7), (5, 1e7))),
    (1.547929286, 11.92638182, 17.92387247, 24.44880138, 33.71473382, 40.18498978, 60.31512992,
     69.24096411, 132.8042596))


def pair(frequency, ratio):
    """Eigenvalue of a mode by its undamped frequency in Hz and its damping ratio."""
    omega = 2.0 * math.pi * frequency
    return (-ratio * omega, omega * math.sqrt(1.0 - ratio**2))


EQUAL = Case(
    "equal", "Two equal discs, modal damping of 2 %", chain((10.0, 10.0), (428400.0,), modal_damping=0.02),
    (0.0, 46.58647608), eigenvalues=(pair(46.58647608, 0.02),))

TUTORIAL = Case(
    "tutorial", "openTorsion's tutorial: five discs, four orders at 3600 rpm, undamped",
    chain((100.0, 10.0, 50.0, 10.0, 80.0), (2.5e7,) * 4),
    (0.0, 58.71232828, 124.8541614, 360.9772493, 378.868411),
    torque=Torque(0, (1, 2, 3, 4), (120.0 * math.pi,), ((200.0, 50.0, 5.0, 2.0),)),
    torques=(((2078.33736, 65.7802752, 0.641056937, 0.0635472128),
              (2188.01986, 52.400152, 0.877172072, 0.212100486),
              (2114.49951, 74.0783066, 0.186235127, 0.00974785556),
              (1979.58842, 82.528911, 0.303631172, 0.0452510427)),), known=3e-9)

RPM = (1.0, 5.0, 10.0, 13.8, 15.0, 20.0)
# Share of the generator's torque that pulsates with each order of the electrical frequency.
RIPPLE = {4: 0.0018, 6: 0.0179, 8: 0.0024, 10: 0.0034, 12: 0.0117, 14: 0.0018, 16: 0.0011}
RATED, COGGING = 2.9e6, 0.0176


def generator(rpm):
    """Torque of the generator: none below 4 rpm, then rising to half, from 15 rpm at constant power."""
    if rpm < 4.0 or rpm >= 22.0:
        return 0.0
    return RATED * (0.125 + 0.375 * (rpm - 4.0) / 11.0 if rpm < 15.0 else 15.0 / rpm)


def pulsation(rpm):
    """Amplitudes of the orders: ripple, and cogging at order 12."""
    return tuple(share * generator(rpm) + (COGGING * RATED if order == 12 else 0.0)
                 for order, share in RIPPLE.items())


# 60 pole pairs: the electrical frequency in Hz, to which the orders refer, is the speed in rpm.
WIND = Case(
    "wind", "Sopanen et al. 2011: direct-drive wind turbine, seven orders, modal damping of 2 %",
    chain((1e7, 5770.0, 97030.0), (3.67e8, 5.496e9), modal_damping=0.02),
    (0.0, 9.285125147, 164.5844693),
    torque=Torque(2, tuple(RIPPLE), tuple(2.0 * math.pi * rpm for rpm in RPM), tuple(map(pulsation, RPM))),
    torques=((75551.8662, 68843.702), (2859.85864, 2617.37913), (1537.08281, 8297.84519),
             (5548.93788, 81918.2654), (2377.8776, 28777.2978), (960.401701, 12428.8555)),
    summed=True, known=2e-9)

FINAL = 3.7


def car(ratio):
    """Kiencke and Nielsen's form: engine and gears, drive shaft, wheels with the car."""
    engine = 0.17 + 0.014 / ratio**2 + 0.031 / (ratio * FINAL)**2
    return Line(3, ((0, engine), (2, 1.0 + 1400.0 * 0.32**2)), (Shaft(1, 2, 5000.0, 65.0),),
                (Gear(0, 1, 1.0, ratio * FINAL),))


def in_gear(number, ratio, frequency, damping, known=1e-6):
    """The passenger car in one of its gears."""
    return Case(f"car-{number}", f"Passenger car in gear {number}, shaft with damping", car(ratio),
                (0.0, frequency), eigenvalues=(pair(frequency, damping),), known=known)


CAR = (in_gear(1, 3.5, 2.298988138, 0.0938922952, 1e-9), in_gear(2, 1.9, 3.9449842, 0.161116),
       in_gear(3, 1.3, 5.5993918, 0.228683), in_gear(4, 0.95, 7.4429062, 0.303974),
       in_gear(5, 0.75, 9.1411501, 0.373331))

MODELICA = Case(
    "modelica", "Modelica.Mechanics.Rotational, First: gear of 10, damper to ground",
    Line(3, ((0, 0.1), (1, 2.0), (2, 2.0)), (Shaft(1, 2, 1e4),), (Gear(0, 1, 1.0, 10.0),),
         ground_damping=((1, 10.0),)),
    (0.0, 12.15565957), eigenvalues=((-0.714296126, 0.0), (-0.0595186037, 76.3756818)))

CASES = (TWO, FIVE, GEARED, STRING, FINE_STRING, GROUNDED, EQUAL, TUTORIAL, WIND, *CAR, MODELICA)
