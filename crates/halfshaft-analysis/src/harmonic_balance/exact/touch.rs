//! Turning points of the twists whose laws have breaks, and what begins or ceases to touch.

use super::super::grazing::six_digits;
use halfshaft_dynamics::EquationsOfMotion;

use crate::shooting::{Step, Turn};

/// Turning points of each twist whose law has breaks, in order of time.
#[derive(Clone, Debug)]
pub(super) struct Turns {
    list: Vec<(usize, Vec<Turn>)>,
}

impl Turns {
    /// Of a line; none seen yet.
    pub(super) fn new(equations: &EquationsOfMotion) -> Self {
        let broken = equations.connections.iter().enumerate();
        let broken = broken.filter(|(_, c)| !c.law.switching_twists().is_empty());
        Self { list: broken.map(|(index, _)| (index, Vec::new())).collect() }
    }

    /// The same twists, none seen yet.
    pub(super) fn cleared(&self) -> Self {
        Self { list: self.list.iter().map(|(index, _)| (*index, Vec::new())).collect() }
    }

    /// Takes in a step.
    pub(super) fn see(&mut self, step: &Step<'_>) {
        for (connection, turns) in &mut self.list {
            step.turns(*connection, turns);
        }
    }

    fn of(&self, connection: usize) -> &[Turn] {
        let own = self.list.iter().find(|(index, _)| *index == connection);
        own.map_or(&[], |(_, turns)| turns)
    }

    /// Least distance of a turning point from a break of its law, rad.
    pub(super) fn nearest(&self, equations: &EquationsOfMotion) -> f64 {
        let mut least = f64::INFINITY;
        for (connection, turns) in &self.list {
            for level in equations.connections[*connection].law.switching_twists() {
                let away = turns.iter().map(|turn| (turn.twist - level).abs());
                least = away.fold(least, f64::min);
            }
        }
        least
    }
}

/// Which twist touches what.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Touch {
    connection: usize,
    /// The switching twist, rad.
    level: f64,
    /// Passages of the level below which an orbit counts as not touching.
    fewer: usize,
}

/// What begins or ceases to touch between two orbits.
pub(super) fn touches(
    equations: &EquationsOfMotion,
    mirrored: bool,
    from: &Turns,
    to: &Turns,
) -> Vec<Touch> {
    let mut found = Vec::new();
    for (connection, before) in &from.list {
        let behind = to.of(*connection);
        let levels = equations.connections[*connection].law.switching_twists();
        // A mirrored orbit touches the mirrored level half a period later.
        for &level in levels.iter().filter(|level| !mirrored || **level >= 0.0) {
            let counts = [passages(before, level), passages(behind, level)];
            if counts[0] != counts[1] {
                let fewer = counts[0].min(counts[1]);
                found.push(Touch { connection: *connection, level, fewer });
            }
        }
    }
    found
}

impl Touch {
    /// How far the nearest turning point is beyond the level, negative while it does not reach it, rad.
    pub(super) fn beyond(&self, turns: &Turns) -> f64 {
        let list = turns.of(self.connection);
        let touching = passages(list, self.level) > self.fewer;
        let over =
            list.iter().map(|t| if t.top { t.twist - self.level } else { self.level - t.twist });
        let near = over.filter(|over| (*over > 0.0) == touching).map(f64::abs);
        let near = near.reduce(f64::min).unwrap_or(f64::NAN);
        if touching { near } else { -near }
    }

    /// As a sentence.
    pub(super) fn words(&self, equations: &EquationsOfMotion, turns: &Turns) -> String {
        let list = turns.of(self.connection).iter();
        let nearest = list
            .min_by(|a, b| (a.twist - self.level).abs().total_cmp(&(b.twist - self.level).abs()));
        let side = if nearest.is_none_or(|turn| turn.top) { "below" } else { "above" };
        let name = &equations.connections[self.connection].name;
        format!("the twist of `{name}` touches {} rad from {side}", six_digits(self.level))
    }
}

/// How often a twist with these turning points passes a level within a period.
fn passages(list: &[Turn], level: f64) -> usize {
    let next = list.iter().cycle().skip(1);
    list.iter().zip(next).filter(|(a, b)| (a.twist > level) != (b.twist > level)).count()
}
