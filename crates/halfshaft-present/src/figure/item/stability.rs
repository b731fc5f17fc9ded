//! A branch drawn by its stability.

use super::{Curve, Line};
use crate::figure::colour::Colour;

impl Curve {
    /// Splits a branch into solid (stable) and dashed (unstable) curves, in order.
    ///
    /// A piece between two neighbouring points is solid only if both are stable. The point at a
    /// change belongs to both curves, so the branch has no gap. All curves share the name; one of
    /// them, solid if any is, stands in the legend. The longest lists are cut to the shortest.
    #[must_use]
    pub fn by_stability(
        name: &str,
        x: &[f64],
        y: &[f64],
        stable: &[bool],
        colour: Colour,
    ) -> Vec<Self> {
        let count = x.len().min(y.len()).min(stable.len());
        let mut curves: Vec<Self> = runs(&stable[..count])
            .into_iter()
            .map(|(first, last, solid)| {
                let (x, y) = (x[first..=last].to_vec(), y[first..=last].to_vec());
                let line = if solid { Line::Solid } else { Line::Dashed };
                Self::new(name, x, y, colour).with_line(line).unlisted()
            })
            .collect();
        let listed = curves.iter().position(|c| c.line == Line::Solid).unwrap_or(0);
        if let Some(curve) = curves.get_mut(listed) {
            curve.in_legend = true;
        }
        curves
    }
}

/// First point, last point and stability of every run of equal pieces.
fn runs(stable: &[bool]) -> Vec<(usize, usize, bool)> {
    if let [only] = stable {
        return vec![(0, 0, *only)];
    }
    let mut runs: Vec<(usize, usize, bool)> = Vec::new();
    for (start, ends) in stable.windows(2).enumerate() {
        let solid = ends[0] && ends[1];
        match runs.last_mut() {
            Some(run) if run.2 == solid => run.1 = start + 1,
            _ => runs.push((start, start + 1, solid)),
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Oracle: the definition, worked by hand for S S U U S S.
    #[test]
    fn joints_belong_to_both_neighbours() {
        let x = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0];
        let stable = [true, true, false, false, true, true];
        let curves = Curve::by_stability("b", &x, &x, &stable, Colour::Blue);
        let parts: Vec<(Line, &[f64])> = curves.iter().map(|c| (c.line, c.x.as_slice())).collect();
        assert_eq!(
            parts,
            [(Line::Solid, &x[0..=1]), (Line::Dashed, &x[1..=4]), (Line::Solid, &x[4..=5]),]
        );
        assert_eq!(curves.iter().filter(|c| c.in_legend).count(), 1);
    }

    /// Oracle: the definition; a solid run stands in the legend even if a dashed one comes first.
    #[test]
    fn the_legend_shows_a_stable_run() {
        let x = [0.0, 1.0, 2.0, 3.0];
        let curves = Curve::by_stability("b", &x, &x, &[false, false, true, true], Colour::Blue);
        assert_eq!(curves.iter().map(|c| c.in_legend).collect::<Vec<_>>(), [false, true]);
    }

    /// Oracle: the definition at its edges: nothing, one point, unequal lengths.
    #[test]
    fn short_inputs_are_fine() {
        assert!(Curve::by_stability("b", &[], &[], &[], Colour::Blue).is_empty());
        let one = Curve::by_stability("b", &[1.0], &[2.0], &[false], Colour::Blue);
        assert_eq!((one.len(), one[0].line, one[0].in_legend), (1, Line::Dashed, true));
        let cut = Curve::by_stability("b", &[1.0, 2.0], &[2.0, 3.0, 4.0], &[true; 9], Colour::Blue);
        assert_eq!(cut[0].x.len(), 2);
    }
}
