//! Taylor coefficients of a line over lanes, one power after the other.
//!
//! ```text
//! (k+1)(k+2) x_{i,k+2} = [b_i + s_i t]_k + Σ_h g_ih cos_h,k + Σ_e a_ie T_e,k + Σ_j d_ij (k+1) x_{j,k+1}
//! ```
//!
//! (A. Griewank, A. Walther, *Evaluating Derivatives* (2008), chapter 13.)

use halfshaft_numerics::ensemble::{
    Band, Expansion, Lanes, Parameters, RECIPROCALS, SeriesSystem, cosine_and_sine, product,
    square, tanh,
};

use super::build::{LaneLine, Row, Shaft};
use super::values::go_to;

impl SeriesSystem for LaneLine {
    fn coordinates(&self) -> usize {
        self.rows.len()
    }

    fn parameters(&self) -> usize {
        self.parameters
    }

    fn helpers(&self) -> usize {
        self.helpers
    }

    #[inline(always)]
    fn expand<L: Lanes>(&self, expansion: &mut Expansion<'_, L>) {
        let Expansion { terms, time, parameters, coordinates, helpers } = expansion;
        let (terms, time, parameters) = (*terms, *time, *parameters);
        for tone in &self.tones {
            let (speed, phase) = (parameters[tone.speed], parameters[tone.phase]);
            let series = &mut helpers[tone.helper * terms..][..2 * terms];
            let (cosine, sine) = series.split_at_mut(terms);
            cosine_and_sine(speed.mul_add(time, phase), speed, cosine, sine);
        }
        for shaft in &self.shafts {
            let start = twist(shaft, parameters, coordinates, terms, 0) - parameters[shaft.origin];
            helpers[shaft.helper * terms] = start;
        }
        for power in 0..terms - 2 {
            for shaft in &self.shafts {
                let next = twist(shaft, parameters, coordinates, terms, power + 1);
                let series = &mut helpers[shaft.helper * terms..][..shaft.helpers() * terms];
                series[power + 1] = next;
                torque(shaft, parameters, series, terms, power);
            }
            let factor = L::splat(RECIPROCALS[power + 1] * RECIPROCALS[power + 2]);
            for (index, row) in self.rows.iter().enumerate() {
                let sum = self.acceleration(row, parameters, coordinates, helpers, terms, power);
                let sum = match power {
                    0 => parameters[row.slope].mul_add(time, parameters[row.constant]) + sum,
                    1 => parameters[row.slope] + sum,
                    _ => sum,
                };
                coordinates[index * terms + power + 2] = sum * factor;
            }
        }
        for shaft in self.shafts.iter().filter(|shaft| shaft.pieces > 1) {
            let last = twist(shaft, parameters, coordinates, terms, terms - 1);
            helpers[shaft.helper * terms + terms - 1] = last;
        }
    }

    fn bands(&self) -> &[Band] {
        &self.bands
    }

    fn pass(&self, band: usize, up: bool, parameters: &mut dyn Parameters) {
        let shaft = &self.shafts[self.watched[band]];
        let piece = parameters.get(shaft.piece) as usize;
        let next = if up { piece + 1 } else { piece.saturating_sub(1) };
        go_to(shaft, next.min(shaft.pieces - 1), parameters);
    }
}

impl LaneLine {
    /// One power of the acceleration of a coordinate, without its constant and slope.
    #[inline(always)]
    fn acceleration<L: Lanes>(
        &self,
        row: &Row,
        parameters: &[L],
        coordinates: &[L],
        helpers: &[L],
        terms: usize,
        power: usize,
    ) -> L {
        let mut sum = L::splat(0.0);
        for (of, place) in &row.drags {
            sum = parameters[*place].mul_add(coordinates[of * terms + power + 1], sum);
        }
        if !row.drags.is_empty() {
            sum = sum * L::splat((power + 1) as f64);
        }
        for (index, place) in &row.tones {
            let cosine = helpers[self.tones[*index].helper * terms + power];
            sum = parameters[*place].mul_add(cosine, sum);
        }
        for (index, place) in &row.torques {
            let torque = helpers[(self.shafts[*index].helper + 1) * terms + power];
            sum = parameters[*place].mul_add(torque, sum);
        }
        sum
    }
}

/// One power of the twist of a connection.
#[inline(always)]
fn twist<L: Lanes>(
    shaft: &Shaft,
    parameters: &[L],
    coordinates: &[L],
    terms: usize,
    power: usize,
) -> L {
    if let Some(coordinate) = shaft.coordinate {
        return coordinates[coordinate * terms + power];
    }
    let mut sum = L::splat(0.0);
    for (coordinate, place) in &shaft.shares {
        sum = parameters[*place].mul_add(coordinates[coordinate * terms + power], sum);
    }
    sum
}

/// One power of the torque of a connection, from its twist known to one power more: law by Horner's
/// rule over series, damping, friction.
#[inline(always)]
fn torque<L: Lanes>(shaft: &Shaft, parameters: &[L], series: &mut [L], terms: usize, power: usize) {
    let law = &parameters[shaft.law..=shaft.law + shaft.degree];
    let (twist, rest) = series.split_at_mut(terms);
    let (torque, rest) = rest.split_at_mut(terms);
    let (partial, dry) = rest.split_at_mut(shaft.law_helpers() * terms);
    let along = match (shaft.degree, shaft.odd) {
        (0, _) => constant(law, 0, power),
        (1, _) => law[1].mul_add(twist[power], constant(law, 0, power)),
        (_, true) => odd_law(law, twist, partial, terms, power),
        (_, false) => any_law(law, twist, partial, terms, power),
    };
    let rate = twist[power + 1] * L::splat((power + 1) as f64);
    torque[power] = parameters[shaft.damping].mul_add(rate, along);
    if let Some([size, speed]) = shaft.friction {
        let tangent = friction(rate * parameters[speed], dry, terms, power);
        torque[power] = parameters[size].mul_add(tangent, torque[power]);
    }
}

/// One power of `tanh w` from that of `w`: `k tanh_k = Σ i w_i (1 - tanh²)_{k-i}`.
#[inline(always)]
fn friction<L: Lanes>(w: L, series: &mut [L], terms: usize, power: usize) -> L {
    let (scaled, rest) = series.split_at_mut(terms);
    let (tangent, slope) = rest.split_at_mut(terms);
    scaled[power] = w * L::splat(power as f64);
    if power == 0 {
        tangent[0] = tanh(w);
        let one = L::splat(1.0);
        slope[0] = (one - tangent[0]) * (one + tangent[0]);
        return tangent[0];
    }
    let sum = product(&scaled[1..=power], &slope[..power]);
    tangent[power] = sum * L::splat(RECIPROCALS[power]);
    slope[power] = -square(&tangent[..=power]);
    tangent[power]
}

/// A coefficient of the law as a series.
#[inline(always)]
fn constant<L: Lanes>(law: &[L], at: usize, power: usize) -> L {
    if power == 0 { law[at] } else { L::splat(0.0) }
}

/// `y (c_1 + u (c_3 + u (c_5 + ...)))` with `u = y²`; partial results: `u`, then the brackets from the
/// innermost on.
#[inline(always)]
fn odd_law<L: Lanes>(law: &[L], y: &[L], partial: &mut [L], terms: usize, power: usize) -> L {
    let (squares, brackets) = partial.split_at_mut(terms);
    squares[power] = square(&y[..=power]);
    let highest = law.len() - 1;
    let mut value = law[highest].mul_add(squares[power], constant(law, highest - 2, power));
    brackets[power] = value;
    let mut from = 0;
    for at in (1..highest - 2).step_by(2).rev() {
        value =
            product(&brackets[from..=from + power], &squares[..=power]) + constant(law, at, power);
        from += terms;
        brackets[from + power] = value;
    }
    product(&brackets[from..=from + power], &y[..=power])
}

/// `c_0 + y (c_1 + y (c_2 + ...))`; partial results: the brackets from the innermost on.
#[inline(always)]
fn any_law<L: Lanes>(law: &[L], y: &[L], brackets: &mut [L], terms: usize, power: usize) -> L {
    let highest = law.len() - 1;
    let mut value = law[highest].mul_add(y[power], constant(law, highest - 1, power));
    let mut from = 0;
    for at in (0..highest - 1).rev() {
        brackets[from + power] = value;
        value = product(&brackets[from..=from + power], &y[..=power]) + constant(law, at, power);
        from += terms;
    }
    value
}
