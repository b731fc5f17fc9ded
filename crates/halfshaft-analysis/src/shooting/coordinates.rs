//! The state of a line as shooting sees it.

use halfshaft_dynamics::EquationsOfMotion;

/// Twists of the spanning tree (rad), their rates over a reference speed, and, for a free line with
/// dampers to ground, the speed of the whole beyond its running over the reference speed. Without
/// dampers to ground a free line's speed has no effect on its twists and is left out; the angle of the
/// whole always is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Coordinates {
    /// Number of tree twists.
    twists: usize,
    with_speed: bool,
    /// Reference speed, rad/s.
    pub(crate) reference: f64,
}

impl Coordinates {
    pub(crate) fn new(equations: &EquationsOfMotion, reference: f64) -> Self {
        let damped = |rigid: &halfshaft_dynamics::RigidBody| rigid.ground_damping > 0.0;
        Self {
            twists: equations.network.tree.len(),
            with_speed: equations.rigid.as_ref().is_some_and(damped),
            reference,
        }
    }

    /// Number of coordinates.
    pub(crate) fn dimension(&self) -> usize {
        2 * self.twists + usize::from(self.with_speed)
    }

    /// Multiplies all rates of a state.
    pub(crate) fn scale_rates(&self, state: &mut [f64], factor: f64) {
        state[self.twists..].iter_mut().for_each(|v| *v *= factor);
    }

    /// Angles and speeds of the groups, without those of the whole where these are left out.
    pub(crate) fn spread(
        &self,
        equations: &EquationsOfMotion,
        state: &[f64],
        angles: &mut [f64],
        speeds: &mut [f64],
    ) {
        equations.group_angles(&state[..self.twists], angles);
        let rates: Vec<f64> =
            state[self.twists..2 * self.twists].iter().map(|v| v * self.reference).collect();
        equations.group_angles(&rates, speeds);
        let Some(rigid) = &equations.rigid else { return };
        let whole = if self.with_speed { self.reference * state[2 * self.twists] } else { 0.0 };
        for (values, mean) in [(angles, 0.0), (speeds, whole)] {
            let shift = mean - rigid.mean(values);
            values.iter_mut().zip(&rigid.speeds).for_each(|(q, r)| *q += shift * r);
        }
    }

    /// The reverse of [`Coordinates::spread`].
    pub(crate) fn gather(
        &self,
        equations: &EquationsOfMotion,
        angles: &[f64],
        speeds: &[f64],
        state: &mut [f64],
    ) {
        for (index, edge) in equations.network.tree.iter().enumerate() {
            state[index] = equations.twist(edge.shaft, angles);
            state[self.twists + index] = equations.twist(edge.shaft, speeds) / self.reference;
        }
        if let (true, Some(rigid)) = (self.with_speed, &equations.rigid) {
            state[2 * self.twists] = rigid.mean(speeds) / self.reference;
        }
    }
}
