//! Channels of the whole line at a response: the linear rest follows from the twist of the shaft.
//!
//! To one harmonic every channel swings evenly about its mean, so its amplitude, half of peak to
//! peak, is its first harmonic.

use halfshaft_numerics::Complex;
use halfshaft_results::{Column, Named};

use super::problem::Problem;
use super::responses::Response;

/// A channel: mean and complex first harmonic.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Value {
    mean: f64,
    harmonic: Complex,
}

/// Name and unit of each channel.
pub(super) fn names(problem: &Problem) -> Vec<(String, &'static str)> {
    let mut names = Vec::new();
    for connection in &problem.equations.connections {
        for (word, unit) in [("twist", "rad"), ("twist_rate", "rad/s"), ("torque", "N·m")] {
            names.push((format!("{}.{word}", connection.name), unit));
        }
    }
    for node in &problem.equations.nodes {
        for (word, unit) in [("angle", "rad"), ("speed", "rad/s")] {
            names.push((format!("{}.{word}", node.name), unit));
        }
    }
    names
}

/// Complex amplitudes of the groups at a response.
pub(super) fn group_amplitudes(problem: &Problem, response: &Response) -> Vec<Complex> {
    let torque = shaft_torque(problem, response);
    let motion = problem.rest.motion(response.nu, &problem.drive, response.twist, torque);
    motion.unwrap_or_else(|| vec![Complex::new(f64::NAN, 0.0); problem.equations.groups()])
}

/// Mean angles of the groups at a response; those of a free line turned so that their mean by inertia
/// is zero.
pub(super) fn mean_angles(problem: &Problem, response: &Response) -> Vec<f64> {
    problem.mean_angles(response.at.mean, mean_torque(problem, response))
}

fn mean_torque(problem: &Problem, response: &Response) -> f64 {
    let law = &problem.law;
    law.law.describing_function(response.at.mean, response.amplitude()).mean_torque
}

/// Complex amplitude of the torque of the shaft, damper and friction included.
fn shaft_torque(problem: &Problem, response: &Response) -> Complex {
    let a = response.amplitude();
    let resistance = problem.law.resistance(response.nu, a, &response.at).torque;
    let gain = if a > 0.0 {
        Complex::new(response.at.force / a, resistance / a)
    } else {
        Complex::from(response.at.slope)
    };
    (gain + Complex::new(0.0, response.nu * problem.law.damping)) * response.twist
}

/// All channels at a response, in the order of [`names`].
fn values(problem: &Problem, response: &Response) -> Vec<Value> {
    let equations = &problem.equations;
    let (groups, means) = (group_amplitudes(problem, response), mean_angles(problem, response));
    let turned = |z: Complex| Complex::new(-response.nu * z.im, response.nu * z.re);
    let mut values = Vec::new();
    for (index, connection) in equations.connections.iter().enumerate() {
        let end = |end: halfshaft_model::End| {
            end.map_or(Value::default(), |(group, ratio)| Value {
                mean: ratio * means[group],
                harmonic: groups[group].scaled(ratio),
            })
        };
        let (from, to) = (end(connection.from), end(connection.to));
        let mut twist = Value { mean: from.mean - to.mean, harmonic: from.harmonic - to.harmonic };
        let torque = if index == problem.shaft {
            twist = Value { mean: response.at.mean, harmonic: response.twist };
            Value {
                mean: mean_torque(problem, response),
                harmonic: shaft_torque(problem, response),
            }
        } else {
            let stiffness = connection.law.stiffness(0.0);
            let complex = Complex::new(stiffness, response.nu * connection.damping);
            Value {
                mean: connection.law.torque(0.0) + stiffness * twist.mean,
                harmonic: complex * twist.harmonic,
            }
        };
        let rate = Value { mean: 0.0, harmonic: turned(twist.harmonic) };
        values.extend([twist, rate, torque]);
    }
    for node in &equations.nodes {
        let angle = Value {
            mean: node.ratio * means[node.group],
            harmonic: groups[node.group].scaled(node.ratio),
        };
        values.extend([angle, Value { mean: 0.0, harmonic: turned(angle.harmonic) }]);
    }
    values
}

/// First harmonics of all channels at a response, in the order of [`names`].
pub(super) fn harmonics(problem: &Problem, response: &Response) -> Vec<f64> {
    values(problem, response).iter().map(|value| value.harmonic.modulus()).collect()
}

/// Columns of a list of responses: `frequency`, three for each channel, stability.
pub(super) fn columns(problem: &Problem, responses: &[&Response]) -> Vec<Column> {
    let rows: Vec<Vec<Value>> =
        responses.iter().map(|response| values(problem, response)).collect();
    let of = |value: &dyn Fn(&Response) -> f64| responses.iter().map(|r| value(r)).collect();
    let mut columns = vec![Column::new("frequency", "rad/s", of(&|r| r.nu / problem.order))];
    for (channel, (name, unit)) in names(problem).into_iter().enumerate() {
        let harmonic: Vec<f64> = rows.iter().map(|row| row[channel].harmonic.modulus()).collect();
        let mean = rows.iter().map(|row| row[channel].mean).collect();
        let mut add = |word: &str, values| {
            columns.push(Column::new(format!("{name}.{word}"), unit, values));
        };
        add("amplitude", harmonic.clone());
        add("mean", mean);
        add("harmonic1", harmonic);
    }
    columns.push(Column::new("stable", "1", of(&|r| f64::from(u8::from(r.is_stable())))));
    columns.push(Column::new(
        "unstable_dimension",
        "1",
        of(&|r| f64::from(r.unstable_dimension())),
    ));
    columns
}

/// The same for one response, by column name, without stability.
pub(super) fn named(problem: &Problem, response: &Response) -> Named<f64> {
    let columns = columns(problem, &[response]).into_iter();
    let plain = columns.filter(|c| c.name != "stable" && c.name != "unstable_dimension");
    plain.map(|column| (column.name, column.values[0])).collect()
}
