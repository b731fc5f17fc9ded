//! The variational equation in the angles of all groups.

use halfshaft_dynamics::{Connection, EquationsOfMotion};

use super::panels::{TERMS, Tangent};
use super::series::INVERSE;
use super::structure::{BLOCK, Structure, axpy, dampers, springs, sums, times, with_speed};

/// The whole line: the columns are changes of the twists of its tree and of their rates.
#[derive(Debug)]
pub(super) struct WholeLine<'e> {
    equations: &'e EquationsOfMotion,
    connections: Vec<usize>,
    joints: Vec<[Joint; 2]>,
    /// Groups without a connection, and the acceleration of each by its rate.
    alone: Vec<(usize, f64)>,
    with_speed: bool,
}

/// Where a connection meets a group.
#[derive(Clone, Copy, Debug)]
struct Joint {
    group: usize,
    /// What an angle of the group adds to the twist; nothing at ground.
    ratio: f64,
    /// Acceleration of the group by the torque of the connection.
    answer: f64,
    /// Its acceleration by its rate, where the connection is the first that meets it.
    drag: Option<f64>,
}

impl<'e> WholeLine<'e> {
    pub(super) fn new(equations: &'e EquationsOfMotion) -> Self {
        let joints = joints(equations);
        Self {
            connections: (0..equations.connections.len()).collect(),
            alone: alone(equations, &joints),
            joints,
            with_speed: with_speed(equations),
            equations,
        }
    }

    /// The equations that it is made of.
    pub(super) fn equations(&self) -> &'e EquationsOfMotion {
        self.equations
    }

    /// The coefficients of the angles two powers of time above `power`, which is number `STAGE` of a
    /// block. In the first of a block springs do what they do by the twists known then in all of it;
    /// that waits in the places of the twists to come, so that the others have only the newest twists
    /// left, and their dampers.
    #[inline(always)]
    fn pass<const W: usize, const FUSED: bool, const STAGE: usize>(
        &self,
        power: usize,
        tangents: &[Tangent],
        angles: &mut [[f64; W]],
        twists: &mut [[f64; W]],
    ) {
        let groups = self.equations.groups();
        let (next, inverse) = ((power + 1) as f64, INVERSE[power + 1] * INVERSE[power + 2]);
        let (known, later) = angles.split_at_mut((power + 2) * groups);
        let rates = &known[(power + 1) * groups..];
        for (group, drag) in &self.alone {
            later[*group] = times(inverse * next * drag, &rates[*group]);
        }
        let (rates, later) = (&rates[..groups], &mut later[..groups]);
        let rows = twists.chunks_exact_mut(TERMS);
        for ((joints, tangent), row) in self.joints.iter().zip(tangents).zip(rows) {
            let (known, new) = row.split_at_mut(power + 1);
            let mut torque = new[0];
            let newest = twist::<W, FUSED>(joints, rates);
            new[0] = newest;
            if STAGE == 0 {
                let [now, first, second, third] = springs::<W, FUSED>(tangent, &newest, known);
                torque = now;
                new[1] = first;
                new[2] = second;
                new[3] = third;
            }
            for back in 1..STAGE {
                axpy::<W, FUSED>(
                    tangent.stiffness[back - 1],
                    &known[power + 1 - back],
                    &mut torque,
                );
            }
            dampers::<W, FUSED>(tangent, &newest, known, &mut torque);
            let torque = times(inverse, &torque);
            for joint in joints {
                let angle = &mut later[joint.group];
                if let Some(drag) = joint.drag {
                    *angle = times(inverse * next * drag, &rates[joint.group]);
                }
                axpy::<W, FUSED>(joint.answer, &torque, angle);
            }
        }
    }
}

/// Both ends of all connections. An end at ground stands at the group of the other, where it does
/// nothing.
fn joints(equations: &EquationsOfMotion) -> Vec<[Joint; 2]> {
    let mut drags: Vec<_> = drags(equations).map(Some).collect();
    let ends = |connection: &Connection| {
        let other = connection.from.or(connection.to).map_or(0, |(group, _)| group);
        let mut joint = |end: Option<(usize, f64)>, sign: f64| {
            let (group, ratio) = end.unwrap_or((other, 0.0));
            let ratio = sign * ratio;
            let answer = -ratio / equations.inertia[group];
            let drag = drags[group].take();
            Joint { group, ratio, answer, drag }
        };
        [joint(connection.from, 1.0), joint(connection.to, -1.0)]
    };
    equations.connections.iter().map(ends).collect()
}

/// Acceleration of each group by its rate.
fn drags(equations: &EquationsOfMotion) -> impl Iterator<Item = f64> {
    equations.inertia.iter().zip(&equations.ground_damping).map(|(m, d)| -d / m)
}

/// Groups that no joint meets, and their accelerations.
fn alone(equations: &EquationsOfMotion, joints: &[[Joint; 2]]) -> Vec<(usize, f64)> {
    let met = |group| joints.as_flattened().iter().any(|joint| joint.group == group);
    drags(equations).enumerate().filter(|(group, _)| !met(*group)).collect()
}

/// Twist of a connection from the angles of the groups, all columns of a panel.
#[inline(always)]
fn twist<const W: usize, const FUSED: bool>(
    [from, to]: &[Joint; 2],
    angles: &[[f64; W]],
) -> [f64; W] {
    let part = times(from.ratio, &angles[from.group]);
    sums::<W, FUSED>(to.ratio, &angles[to.group], &part)
}

impl Structure for WholeLine<'_> {
    fn coordinates(&self) -> usize {
        self.equations.groups()
    }

    fn columns(&self) -> usize {
        2 * self.equations.network.tree.len() + usize::from(self.with_speed)
    }

    fn connections(&self) -> &[usize] {
        &self.connections
    }

    fn start(&self, speed: f64, set: &mut dyn FnMut(usize, usize, &[f64])) {
        let equations = self.equations;
        let tree = equations.network.tree.len();
        let mut unit = vec![0.0; tree];
        let mut values = vec![0.0; equations.groups()];
        for edge in 0..tree {
            unit.fill(0.0);
            unit[edge] = 1.0;
            equations.group_angles(&unit, &mut values);
            if let Some(rigid) = &equations.rigid {
                let mean = rigid.mean(&values);
                values.iter_mut().zip(&rigid.speeds).for_each(|(q, r)| *q -= mean * r);
            }
            set(edge, 0, &values);
            values.iter_mut().for_each(|value| *value *= speed);
            set(tree + edge, 1, &values);
        }
        if let (true, Some(rigid)) = (self.with_speed, &equations.rigid) {
            let values: Vec<f64> = rigid.speeds.iter().map(|r| speed * r).collect();
            set(2 * tree, 1, &values);
        }
    }

    #[inline(always)]
    fn recur<const W: usize, const FUSED: bool>(
        &self,
        tangents: &[Tangent],
        degree: usize,
        angles: &mut [[f64; W]],
        twists: &mut [[f64; W]],
        _: &mut [[f64; W]],
    ) {
        for (joints, row) in self.joints.iter().zip(twists.chunks_exact_mut(TERMS)) {
            row[0] = twist::<W, FUSED>(joints, &angles[..self.equations.groups()]);
        }
        let mut power = 0;
        // Only the first block, where there is little to do, may be short.
        let mut short = (degree - 1) % BLOCK;
        while power < degree - 1 {
            let end = power + if short == 0 { BLOCK } else { short };
            self.pass::<W, FUSED, 0>(power, tangents, angles, twists);
            if power + 1 < end {
                self.pass::<W, FUSED, 1>(power + 1, tangents, angles, twists);
            }
            if power + 2 < end {
                self.pass::<W, FUSED, 2>(power + 2, tangents, angles, twists);
            }
            if power + 3 < end {
                self.pass::<W, FUSED, 3>(power + 3, tangents, angles, twists);
            }
            (power, short) = (end, 0);
        }
    }

    fn finish(&self, power: usize, values: &[f64], set: &mut dyn FnMut(usize, f64)) {
        let tree = &self.equations.network.tree;
        for (edge, shaft) in tree.iter().enumerate() {
            set(power * tree.len() + edge, self.equations.twist(shaft.shaft, values));
        }
        if let (true, true, Some(rigid)) = (power == 1, self.with_speed, &self.equations.rigid) {
            set(2 * tree.len(), rigid.mean(values));
        }
    }
}
