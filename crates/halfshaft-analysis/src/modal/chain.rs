//! Undamped modes of lines whose bodies stand in a row, gears between them or not.
//!
//! Along the row each body is measured in the turning of the first: with the ratio that makes the twist of
//! every shaft a plain difference, the line is a chain of masses and springs.

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_numerics::chain::Chain;
use halfshaft_numerics::pencil::{EigenPair, PencilTerm};

use super::elastic::ElasticMode;
use super::sparse::terms;

/// Springs and bodies of a line.
struct Row<'l> {
    equations: &'l EquationsOfMotion,
    /// Groups in their order.
    order: Vec<usize>,
    /// Turning of each group of the order for one turn of the row.
    ratios: Vec<f64>,
    /// Stiffness between neighbours, in the turning of the row.
    links: Vec<f64>,
}

/// The lowest elastic modes about given twists; `None` where the line is no row of bodies and springs, or
/// where its modes are too close to be told apart one by one.
pub(super) fn lowest(
    equations: &EquationsOfMotion,
    twists: &[f64],
    count: usize,
) -> Option<Vec<ElasticMode>> {
    let (row, chain) = Row::of(equations, twists)?;
    let first = usize::from(equations.rigid.is_some());
    Some(chain.eigenpairs(first, count)?.iter().map(|pair| row.mode(pair)).collect())
}

/// The squares of all natural frequencies, ascending, without the rigid-body motion; `None` where the line
/// is no row.
pub(super) fn eigenvalues(equations: &EquationsOfMotion, twists: &[f64]) -> Option<Vec<f64>> {
    let (_, chain) = Row::of(equations, twists)?;
    let mut values = chain.eigenvalues()?;
    values.drain(..usize::from(equations.rigid.is_some()));
    Some(values)
}

impl<'l> Row<'l> {
    fn of(equations: &'l EquationsOfMotion, twists: &[f64]) -> Option<(Self, Chain)> {
        let springs = terms(equations, twists).into_iter().filter(|term| term.stiffness != 0.0);
        let (links, held): (Vec<_>, Vec<_>) = springs.partition(|term| term.second.is_some());
        let mut ground = vec![0.0; equations.groups()];
        for PencilTerm { first: (group, ratio), stiffness, .. } in held {
            ground[group] += stiffness * ratio * ratio;
        }
        let row = Self::along(equations, &links)?;
        let chain = row.chain(&ground)?;
        Some((row, chain))
    }

    /// Walks from one end to the other.
    fn along(equations: &'l EquationsOfMotion, springs: &[PencilTerm]) -> Option<Self> {
        let groups = equations.groups();
        let mut of_group: Vec<Vec<usize>> = vec![Vec::new(); groups];
        for (index, spring) in springs.iter().enumerate() {
            let ends = [Some(spring.first), spring.second];
            ends.into_iter().flatten().for_each(|(group, _)| of_group[group].push(index));
        }
        if springs.len() + 1 != groups || of_group.iter().any(|links| links.len() > 2) {
            return None;
        }
        let start = of_group.iter().position(|links| links.len() < 2)?;
        let (mut order, mut ratios, mut links) = (vec![start], vec![1.0], Vec::new());
        let mut last = None;
        let (mut group, mut ratio) = (start, 1.0);
        while let Some(next) = of_group[group].iter().copied().find(|link| Some(*link) != last) {
            let PencilTerm { first, second, stiffness, .. } = springs[next];
            let second = second?;
            let ((_, here), (there, across)) =
                if first.0 == group { (first, second) } else { (second, first) };
            links.push(stiffness * (here * ratio).powi(2));
            (last, group, ratio) = (Some(next), there, -ratio * here / across);
            order.push(group);
            ratios.push(ratio);
            if order.len() > groups {
                return None;
            }
        }
        (order.len() == groups).then_some(Self { equations, order, ratios, links })
    }

    fn chain(&self, ground: &[f64]) -> Option<Chain> {
        let placed = |values: &[f64]| -> Vec<f64> {
            let bodies = self.order.iter().zip(&self.ratios);
            bodies.map(|(group, ratio)| values[*group] * ratio * ratio).collect()
        };
        Chain::new(placed(&self.equations.inertia), &self.links, &placed(ground))
    }

    fn mode(&self, pair: &EigenPair) -> ElasticMode {
        let mut shape = vec![0.0; self.order.len()];
        for ((group, ratio), x) in self.order.iter().zip(&self.ratios).zip(&pair.vector) {
            shape[*group] = ratio * x;
        }
        let connections = 0..self.equations.connections.len();
        let twists = connections.map(|index| self.equations.twist(index, &shape)).collect();
        ElasticMode { eigenvalue: pair.value, shape, twists }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modal::elastic::ElasticSpace;
    use halfshaft_model::{Driveline, Source, read_model};

    fn line(text: &str) -> Driveline {
        let text = format!("format = 1\nname = \"row\"\n{text}");
        read_model(Source::new("row.toml", text), &[]).unwrap().0
    }

    /// Bodies told out of their order, a gear between two of them, and a spring to ground.
    const GEARED: &str = r#"
        inertia = [
            { name = "c", inertia = 4.0 },
            { name = "a", inertia = 0.3 },
            { name = "b", inertia = 0.7 },
            { name = "d", inertia = 90.0 },
        ]
        gear = [{ name = "g", input = "b", output = "b2", ratio = -3.5 }]
        shaft = [
            { name = "cd", from = "d", to = "c", stiffness = 7e3 },
            { name = "ab", from = "a", to = "b", stiffness = 2e3 },
            { name = "bc", from = "b2", to = "c", stiffness = 5e4 },
            { name = "held", from = "c", to = "ground", stiffness = 300.0 },
        ]"#;

    // Source: the dense solver, which knows nothing of rows.
    #[test]
    fn a_row_has_the_modes_of_the_dense_solver() {
        for text in [
            GEARED,
            &GEARED.replace(
                "{ name = \"held\", from = \"c\", to = \"ground\", stiffness = 300.0 },",
                "",
            ),
        ] {
            let equations = EquationsOfMotion::consistent(&line(text)).unwrap();
            let twists = vec![0.0; equations.connections.len()];
            let modes = lowest(&equations, &twists, 9).unwrap();
            let dense = ElasticSpace::new(&equations).modes(&equations, &twists).unwrap();
            assert_eq!(modes.len(), dense.len());
            for (mode, dense) in modes.iter().zip(&dense) {
                assert!((mode.eigenvalue / dense.eigenvalue - 1.0).abs() < 1e-12);
                let sign = (mode.shape[0] * dense.shape[0]).signum();
                let pairs = mode.shape.iter().zip(&dense.shape);
                let pairs = pairs.chain(mode.twists.iter().zip(&dense.twists));
                for (value, wanted) in pairs {
                    assert!((value - sign * wanted).abs() < 1e-12, "{value} {wanted}");
                }
            }
        }
    }

    #[test]
    fn branches_rings_and_parted_lines_are_no_rows() {
        let branched = GEARED.replace("from = \"d\", to = \"c\"", "from = \"d\", to = \"b\"");
        let closed = GEARED.replace("to = \"ground\"", "to = \"b2\"");
        let parted = GEARED.replace("stiffness = 7e3", "stiffness = 0, damping = 3");
        for text in [branched, closed, parted] {
            let equations = EquationsOfMotion::consistent(&line(&text)).unwrap();
            let twists = vec![0.0; equations.connections.len()];
            assert_eq!(lowest(&equations, &twists, 9), None);
        }
    }
}
