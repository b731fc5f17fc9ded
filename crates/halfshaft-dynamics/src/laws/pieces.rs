//! Any law as polynomials joined end to end: for all twists with a torque, for turning points, for
//! laws in parallel.

use halfshaft_numerics::polynomial::Polynomial;

/// One polynomial of the twist from its origin.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// Where the piece begins, rad; minus infinity for the first.
    pub from: f64,
    /// Where it ends, rad; infinity for the last.
    pub to: f64,
    /// Twist from which the polynomial counts, rad.
    pub origin: f64,
    /// Torque over `x - origin`, N·m.
    pub torque: Polynomial,
}

/// A torque over the twist as polynomials joined end to end.
#[derive(Clone, Debug, PartialEq)]
pub struct Pieces {
    pieces: Vec<Piece>,
}

impl Pieces {
    /// Pieces from ascending breaks and, one more than these, origins with their polynomials.
    pub(super) fn new(breaks: &[f64], torques: impl Iterator<Item = (f64, Polynomial)>) -> Self {
        let from = std::iter::once(f64::NEG_INFINITY).chain(breaks.iter().copied());
        let to = breaks.iter().copied().chain(std::iter::once(f64::INFINITY));
        let pieces = from.zip(to).zip(torques).map(|((from, to), (origin, torque))| Piece {
            from,
            to,
            origin,
            torque,
        });
        Self { pieces: pieces.collect() }
    }

    /// The pieces by ascending twist, end to end.
    pub fn list(&self) -> &[Piece] {
        &self.pieces
    }

    /// Torque at twist `x`, N·m.
    pub fn torque(&self, x: f64) -> f64 {
        let piece = self.at(x);
        piece.torque.evaluate(x - piece.origin)
    }

    /// Tangent stiffness at twist `x`, N·m/rad; at a break that of the lower piece.
    pub fn stiffness(&self, x: f64) -> f64 {
        let piece = self.at(x);
        piece.torque.evaluate_with_slope(x - piece.origin).1
    }

    /// The largest tangent stiffness at zero twist and where pieces join, by magnitude: a scale of
    /// the law, N·m/rad.
    pub fn stiffness_scale(&self) -> f64 {
        let slope = |piece: &Piece, x: f64| piece.torque.evaluate_with_slope(x - piece.origin).1;
        let ends = self.pieces.iter().flat_map(|piece| {
            let ends = [piece.from, piece.to].into_iter().filter(|x| x.is_finite());
            ends.map(move |x| slope(piece, x).abs())
        });
        ends.fold(self.stiffness(0.0).abs(), f64::max)
    }

    fn at(&self, x: f64) -> &Piece {
        let index = self.pieces.partition_point(|piece| piece.to < x);
        &self.pieces[index.min(self.pieces.len() - 1)]
    }

    /// `a · T(a · x)`: the law of a connection that twists `a` times as far, with `a` not zero; -1 is
    /// the law seen from the other end.
    #[must_use]
    pub fn stretched(&self, a: f64) -> Self {
        let piece = |piece: &Piece| {
            let mut power = a;
            let coefficients = piece.torque.coefficients().iter().map(|c| {
                let coefficient = c * power;
                power *= a;
                coefficient
            });
            let torque = Polynomial::new(coefficients.collect::<Vec<f64>>());
            let (from, to) = (piece.from / a, piece.to / a);
            let (from, to) = if a > 0.0 { (from, to) } else { (to, from) };
            Piece { from, to, origin: piece.origin / a, torque }
        };
        let mut pieces: Vec<Piece> = self.pieces.iter().map(piece).collect();
        if a < 0.0 {
            pieces.reverse();
        }
        Self { pieces }
    }

    /// The sum of two laws: connections in parallel.
    #[must_use]
    pub fn add(&self, other: &Self) -> Self {
        let starts = self.pieces.iter().chain(&other.pieces).map(|piece| piece.from);
        let mut breaks: Vec<f64> = starts.filter(|from| from.is_finite()).collect();
        breaks.sort_by(f64::total_cmp);
        breaks.dedup();
        let inside =
            |index: usize| match (index.checked_sub(1).map(|i| breaks[i]), breaks.get(index)) {
                (Some(from), Some(to)) => 0.5 * (from + to),
                (Some(from), None) => from + from.abs().max(1.0),
                (None, Some(to)) => to - to.abs().max(1.0),
                (None, None) => 0.0,
            };
        let sum = |index: usize| {
            let x = inside(index);
            let (a, b) = (self.at(x), other.at(x));
            // One origin for both; where one of them has several pieces, its own.
            let origin = if self.pieces.len() >= other.pieces.len() { a.origin } else { b.origin };
            let about = |piece: &Piece| piece.torque.shifted(origin - piece.origin);
            (origin, about(a).add(&about(b)))
        };
        let torques: Vec<_> = (0..=breaks.len()).map(sum).collect();
        Self::new(&breaks, torques.into_iter())
    }

    /// All twists with the given torque, ascending.
    ///
    /// Where the law is flat at that torque, all twists of the flat part have it and one stands for
    /// them: the middle, or the end where the part goes on for ever (zero where it has no end).
    pub fn twists_at(&self, torque: f64) -> Vec<f64> {
        let mut found: Vec<f64> = Vec::new();
        let mut flat: Option<(f64, f64)> = None;
        for piece in &self.pieces {
            let rest = piece.torque.add(&Polynomial::new([-torque]));
            if rest.is_zero() {
                flat = Some((flat.map_or(piece.from, |(from, _)| from), piece.to));
                continue;
            }
            found.extend(flat.take().map(representative));
            let roots = rest.real_roots_in(piece.from - piece.origin, piece.to - piece.origin);
            found.extend(roots.iter().map(|root| root.value + piece.origin));
        }
        found.extend(flat.map(representative));
        self.without_repetitions(found)
    }

    /// One of each twist found from both sides of a break, and none at the ends of a flat part beside
    /// the one that stands for it.
    fn without_repetitions(&self, mut found: Vec<f64>) -> Vec<f64> {
        found.sort_by(f64::total_cmp);
        let mut kept: Vec<f64> = Vec::with_capacity(found.len());
        for x in found {
            match kept.last() {
                Some(last) if self.joined(*last, x) => {
                    // Of a flat part its middle stays.
                    if self.is_flat_inside(x) {
                        kept.pop();
                        kept.push(x);
                    }
                }
                _ => kept.push(x),
            }
        }
        kept
    }

    fn is_flat_inside(&self, x: f64) -> bool {
        let piece = self.at(x);
        piece.torque.degree() == 0 && piece.from < x && x < piece.to
    }

    /// Whether two twists of one torque are the same, or of one flat part.
    fn joined(&self, a: f64, b: f64) -> bool {
        if b - a <= 8.0 * f64::EPSILON * a.abs().max(b.abs()) {
            return true;
        }
        let between = |piece: &&Piece| piece.to > a && piece.from < b;
        self.pieces.iter().filter(between).all(|piece| piece.torque.degree() == 0)
    }
}

/// The twist that stands for a flat part.
fn representative((from, to): (f64, f64)) -> f64 {
    match (from.is_finite(), to.is_finite()) {
        (true, true) => 0.5 * (from + to),
        (true, false) => from,
        (false, true) => to,
        (false, false) => 0.0,
    }
}
