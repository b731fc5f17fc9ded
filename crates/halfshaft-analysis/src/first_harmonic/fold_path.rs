//! Fold curves over a parameter: `g = ∂g/∂u = 0` in `(ν, u = ln a, p)`, step by step.
//!
//! On the way `∂²g/∂u²` changes sign at a cusp, where two folds meet, and `∂g/∂ν` where the
//! parameter turns: there a detached response is born, where the equation's left side has a minimum
//! or maximum over `(ν, u)`, or joins another, where it has a saddle.

use halfshaft_results::SpecialKind;

use super::family::{Family, Spot};
use super::path::{norm, solve_three, tangent};
use super::problem::Residual;

/// A spot of a fold curve with its local shape.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Fold {
    pub(super) spot: Spot,
    pub(super) residual: Residual,
    /// Scaled direction of the curve, of length one.
    pub(super) direction: [f64; 3],
    /// Sense of the direction; the same all along a curve.
    pub(super) forward: bool,
}

/// A special point on a fold curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Special {
    pub(super) spot: Spot,
    pub(super) kind: SpecialKind,
    /// Size of the last correction, scaled; none where the point is only bracketed.
    pub(super) precision: Option<f64>,
}

/// Fold curves of a family with the scales of the plane.
pub(super) struct FoldPath<'f> {
    pub(super) family: &'f Family<'f>,
    /// Length of the range of circular frequencies, rad/s.
    pub(super) width: f64,
}

/// Newton steps of a corrector.
const STEPS: usize = 12;

impl FoldPath<'_> {
    fn scales(&self) -> [f64; 3] {
        [self.width, 1.0, self.family.width]
    }

    fn moved(&self, spot: &Spot, step: &[f64; 3]) -> Spot {
        let [nu, u, parameter] = self.scales();
        Spot {
            nu: spot.nu + step[0] * nu,
            u: spot.u + step[1] * u,
            parameter: spot.parameter + step[2] * parameter,
            mean: spot.mean,
        }
    }

    /// The spot at a scaled distance along the curve's direction.
    pub(super) fn ahead(&self, fold: &Fold, length: f64) -> Spot {
        self.moved(&fold.spot, &fold.direction.map(|d| length * d))
    }

    /// Scaled vector from one spot to another.
    pub(super) fn between(&self, from: &Spot, to: &Spot) -> [f64; 3] {
        let [nu, u, parameter] = self.scales();
        [(to.nu - from.nu) / nu, (to.u - from.u) / u, (to.parameter - from.parameter) / parameter]
    }

    fn rows(&self, residual: &Residual, by_parameter: [f64; 2]) -> [[f64; 3]; 2] {
        let [nu, u, parameter] = self.scales();
        let row = |row: [f64; 3]| {
            let size = norm(&row);
            (row.map(|x| x / size), size)
        };
        let first = [residual.by_nu * nu, residual.by_u * u, by_parameter[0] * parameter];
        let second = [residual.by_nu_u * nu, residual.by_u_u * u, by_parameter[1] * parameter];
        [row(first).0, row(second).0]
    }

    /// The curve's spot across a direction from a guess; `towards` turns its own direction.
    pub(super) fn correct(
        &self,
        guess: &Spot,
        across: &[f64; 3],
        towards: &[f64; 3],
    ) -> Option<(Fold, usize)> {
        let [nu, u, parameter] = self.scales();
        let mut spot = *guess;
        let mut last = f64::INFINITY;
        let mut slopes = self.family.by_parameter(&spot)?;
        for iteration in 0..STEPS {
            let (residual, at) = self.family.residual(&spot)?;
            spot.mean = at.mean;
            let first = [residual.by_nu * nu, residual.by_u * u, slopes[0] * parameter];
            let second = [residual.by_nu_u * nu, residual.by_u_u * u, slopes[1] * parameter];
            let (n1, n2) = (norm(&first), norm(&second));
            let rows = [first.map(|x| x / n1), second.map(|x| x / n2), *across];
            let step = solve_three(&rows, &[-residual.value / n1, -residual.by_u / n2, 0.0])?;
            let length = norm(&step);
            if length.is_nan() || length >= 0.5 || (iteration > 1 && length > last && length > 1e-9)
            {
                return None;
            }
            spot = self.moved(&spot, &step);
            if length <= 1e-15 || (length <= 1e-12 && length >= 0.5 * last) {
                return Some((self.fold(&spot, towards)?, iteration + 1));
            }
            // Differences cost two lines each: only while the spot moves far.
            if length > 1e-5 {
                slopes = self.family.by_parameter(&spot)?;
            }
            last = length;
        }
        (last <= 1e-9).then(|| self.fold(&spot, towards)).flatten().map(|fold| (fold, STEPS))
    }

    /// The local shape at a spot of the curve.
    pub(super) fn fold(&self, spot: &Spot, towards: &[f64; 3]) -> Option<Fold> {
        let (residual, at) = self.family.residual(spot)?;
        let slopes = self.family.by_parameter(spot)?;
        let (direction, forward) = tangent(&self.rows(&residual, slopes), towards)?;
        Some(Fold { spot: Spot { mean: at.mean, ..*spot }, residual, direction, forward })
    }

    /// The special points between two neighbours on the curve.
    pub(super) fn specials(&self, from: &Fold, to: &Fold) -> Vec<Special> {
        let mut found = Vec::new();
        let changes = |a: f64, b: f64| (a < 0.0) != (b < 0.0);
        if changes(from.residual.by_u_u, to.residual.by_u_u) {
            let (a, b) = (from.residual.by_u_u, to.residual.by_u_u);
            found.push(self.locate(from, to, a / (a - b), |r| r.by_u_u, SpecialKind::Cusp));
        }
        if changes(from.residual.by_nu, to.residual.by_nu) {
            let (a, b) = (from.residual.by_nu, to.residual.by_nu);
            let middle = from.residual;
            let determinant = middle.by_nu_nu * middle.by_u_u - middle.by_nu_u * middle.by_nu_u;
            let kind =
                if determinant > 0.0 { SpecialKind::IsolaBirth } else { SpecialKind::IsolaMerger };
            found.push(self.locate(from, to, a / (a - b), |r| r.by_nu, kind));
        }
        found
    }

    /// The point between two neighbours at which a third quantity vanishes.
    fn locate(
        &self,
        from: &Fold,
        to: &Fold,
        share: f64,
        third: impl Fn(&Residual) -> f64,
        kind: SpecialKind,
    ) -> Special {
        let gap = self.between(&from.spot, &to.spot);
        let mut guess = self.moved(&from.spot, &gap.map(|x| share * x));
        guess.mean = from.spot.mean;
        match self.newton(&guess, third) {
            Some((spot, precision)) if self.is_near(&spot, from, &gap) => {
                let kind = self.kind_at(&spot, kind);
                Special { spot, kind, precision: Some(precision) }
            }
            _ => Special { spot: guess, kind, precision: None },
        }
    }

    fn is_near(&self, spot: &Spot, from: &Fold, gap: &[f64; 3]) -> bool {
        norm(&self.between(&from.spot, spot)) <= 2.0 * norm(gap)
    }

    /// Birth or merger by the shape at the point itself.
    fn kind_at(&self, spot: &Spot, kind: SpecialKind) -> SpecialKind {
        if kind == SpecialKind::Cusp {
            return kind;
        }
        let Some((r, _)) = self.family.residual(spot) else { return kind };
        if r.by_nu_nu * r.by_u_u - r.by_nu_u * r.by_nu_u > 0.0 {
            SpecialKind::IsolaBirth
        } else {
            SpecialKind::IsolaMerger
        }
    }

    /// Newton's method on `g`, `∂g/∂u` and a third quantity, all derivatives by differences: only
    /// the values decide where it ends.
    fn newton(&self, guess: &Spot, third: impl Fn(&Residual) -> f64) -> Option<(Spot, f64)> {
        let values = |spot: &Spot| {
            let (r, at) = self.family.residual(spot)?;
            Some(([r.value, r.by_u, third(&r)], at.mean))
        };
        let mut spot = *guess;
        let mut last = f64::INFINITY;
        for _ in 0..STEPS * 2 {
            let (here, mean) = values(&spot)?;
            spot.mean = mean;
            let mut rows = [[0.0; 3]; 3];
            for axis in 0..3 {
                let mut step = [0.0; 3];
                step[axis] = 1e-5;
                let (above, _) = values(&self.moved(&spot, &step))?;
                let (below, _) = values(&self.moved(&spot, &step.map(|s| -s)))?;
                for row in 0..3 {
                    rows[row][axis] = (above[row] - below[row]) / 2e-5;
                }
            }
            let sizes = rows.map(|row| norm(&row));
            let mut right = [0.0; 3];
            for row in 0..3 {
                rows[row] = rows[row].map(|x| x / sizes[row]);
                right[row] = -here[row] / sizes[row];
            }
            let step = solve_three(&rows, &right)?;
            let length = norm(&step);
            if length.is_nan() || length >= 1.0 {
                return None;
            }
            let damping = (0.1 / length).min(1.0);
            spot = self.moved(&spot, &step.map(|s| damping * s));
            if length <= 1e-14 || (length <= 1e-9 && length >= 0.2 * last) {
                return Some((spot, length));
            }
            last = length;
        }
        (last <= 1e-8).then_some((spot, last))
    }
}
