//! Coefficients of the Dormand-Prince pair 5(4) with its dense output of order 4.
//!
//! E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, 2nd ed.
//! (1993), table II.5.2 (method) and section II.6 (dense output); J. R. Dormand, P. J. Prince,
//! J. Comput. Appl. Math. 6 (1980) 19. Stages are counted from 0: stage 6 is the derivative at the
//! end of the step. A row lists only the coefficients that are not zero, each with its stage.

use crate::ode::lanes::Term;

/// Stages of a step.
pub(super) const STAGES: usize = 7;

/// Times of the stages in the step.
pub(super) const C: [f64; STAGES] = [0.0, 1.0 / 5.0, 3.0 / 10.0, 4.0 / 5.0, 8.0 / 9.0, 1.0, 1.0];

/// Row of stage 1.
pub(super) const A1: [Term; 1] = [(0, 1.0 / 5.0)];

/// Row of stage 2.
pub(super) const A2: [Term; 2] = [(0, 3.0 / 40.0), (1, 9.0 / 40.0)];

/// Row of stage 3.
pub(super) const A3: [Term; 3] = [(0, 44.0 / 45.0), (1, -56.0 / 15.0), (2, 32.0 / 9.0)];

/// Row of stage 4.
pub(super) const A4: [Term; 4] = [
    (0, 19_372.0 / 6_561.0),
    (1, -25_360.0 / 2_187.0),
    (2, 64_448.0 / 6_561.0),
    (3, -212.0 / 729.0),
];

/// Row of stage 5.
pub(super) const A5: [Term; 5] = [
    (0, 9_017.0 / 3_168.0),
    (1, -355.0 / 33.0),
    (2, 46_732.0 / 5_247.0),
    (3, 49.0 / 176.0),
    (4, -5_103.0 / 18_656.0),
];

/// Weights of the solution of order 5, the row of stage 6.
pub(super) const B: [Term; 5] = [
    (0, 35.0 / 384.0),
    (2, 500.0 / 1_113.0),
    (3, 125.0 / 192.0),
    (4, -2_187.0 / 6_784.0),
    (5, 11.0 / 84.0),
];

/// Weights of the error estimate: those of order 5 less those of order 4.
pub(super) const E: [Term; 6] = [
    (0, 71.0 / 57_600.0),
    (2, -71.0 / 16_695.0),
    (3, 71.0 / 1_920.0),
    (4, -17_253.0 / 339_200.0),
    (5, 22.0 / 525.0),
    (6, -1.0 / 40.0),
];

/// Weights of coefficient 4 of the dense output.
pub(super) const D4: [Term; 6] = [
    (0, -12_715_105_075.0 / 11_282_082_432.0),
    (2, 87_487_479_700.0 / 32_700_410_799.0),
    (3, -10_690_763_975.0 / 1_880_347_072.0),
    (4, 701_980_252_875.0 / 199_316_789_632.0),
    (5, -1_453_857_185.0 / 822_651_844.0),
    (6, 69_997_945.0 / 29_380_423.0),
];
