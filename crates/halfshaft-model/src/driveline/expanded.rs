//! Elements that stand for several others, written out.

use std::borrow::Cow;
use std::collections::HashMap;

use super::Driveline;
use crate::elements::{Dimensions, Inertia, Shaft};

/// The line with bars in so many pieces, at most, and dampers as rings; itself where it has none of
/// them.
pub(super) fn of(line: &Driveline, most_pieces: usize) -> Cow<'_, Driveline> {
    let bars = line.shafts.iter().any(|shaft| shaft.dimensions.is_some());
    if !bars && line.dampers.is_empty() {
        return Cow::Borrowed(line);
    }
    let mut plain = line.clone();
    for damper in std::mem::take(&mut plain.dampers) {
        plain.inertias.push(damper.ring());
        plain.shafts.push(damper.coupling());
    }
    let mut nodes = Nodes::of(&plain);
    let mut further = Vec::new();
    for shaft in &mut plain.shafts {
        if let Some(bar) = shaft.dimensions.take() {
            let count = bar.pieces().min(most_pieces);
            let mut pieces = cut(shaft, &bar, count, &mut nodes).into_iter();
            if let Some(first) = pieces.next() {
                *shaft = first;
            }
            further.extend(pieces);
        }
    }
    plain.shafts.extend(further);
    plain.inertias = nodes.inertias;
    Cow::Owned(plain)
}

/// Inertias to which those of bars are added.
struct Nodes {
    inertias: Vec<Inertia>,
    by_name: HashMap<String, usize>,
}

impl Nodes {
    fn of(line: &Driveline) -> Self {
        let inertias = line.inertias.clone();
        let by_name =
            inertias.iter().enumerate().map(|(index, e)| (e.name.clone(), index)).collect();
        Self { inertias, by_name }
    }

    fn add(&mut self, node: &str, inertia_kg_m2: f64) {
        if inertia_kg_m2 == 0.0 || node == crate::GROUND {
            return;
        }
        if let Some(index) = self.by_name.get(node) {
            self.inertias[*index].inertia_kg_m2 += inertia_kg_m2;
            return;
        }
        self.by_name.insert(node.to_owned(), self.inertias.len());
        let name = node.to_owned();
        self.inertias.push(Inertia { name, inertia_kg_m2, damping_nm_s_per_rad: 0.0 });
    }
}

/// The pieces of a bar: `N` in a row, each `N` times as stiff and as strongly damped as the whole.
fn cut(shaft: &Shaft, bar: &Dimensions, count: usize, nodes: &mut Nodes) -> Vec<Shaft> {
    #[expect(clippy::cast_precision_loss, reason = "bounded by the file format")]
    let pieces = count as f64;
    let inertia = bar.inertia() / pieces;
    let node = |number: usize| match number {
        0 => shaft.from.clone(),
        last if last == count => shaft.to.clone(),
        inner => format!("{}.node {inner}", shaft.name),
    };
    (0..count)
        .map(|number| {
            let ends = [node(number), node(number + 1)];
            ends.iter().for_each(|end| nodes.add(end, inertia / 2.0));
            let name = match count {
                1 => shaft.name.clone(),
                _ => format!("{}.{}", shaft.name, number + 1),
            };
            Shaft {
                damping_nm_s_per_rad: shaft.damping_nm_s_per_rad * pieces,
                loss_factor: shaft.loss_factor,
                preload_nm: shaft.preload_nm,
                inertance_kg_m2: -inertia / 6.0,
                ..Shaft::linear(name, ends, bar.stiffness() * pieces)
            }
        })
        .collect()
}
