//! Any function as polynomials joined end to end, by sampling it where that is needed.

use std::convert::Infallible;

use super::{Polynomial, chebyshev};

/// Part of the range below which no piece is cut further.
const NARROWEST: f64 = 1e-7;
/// Pieces at most.
const MOST: usize = 400;
/// Places that are told at most.
const TOLD: usize = 8;
/// Distance from zero of the cuts about it, over that of the nearer end.
const ABOUT_ZERO: f64 = 0.4;
/// Jump of the slope at a cut, over the largest slope there, that is more than rounding.
const BEND: f64 = 1e-8;
/// What differs in an odd function on both sides of zero, over its largest value.
const ODD: f64 = 1e-15;

/// A function as polynomials joined end to end, which go on straight beyond its range.
#[derive(Clone, Debug, PartialEq)]
pub struct Sampled {
    /// Where a piece ends and the next begins, ascending; the first and the last are the ends of the
    /// range.
    pub breaks: Vec<f64>,
    /// Origins with polynomials of the distance from them, one more than breaks.
    pub pieces: Vec<(f64, Polynomial)>,
    /// How often the function was evaluated.
    pub evaluations: usize,
}

/// Why a function cannot be sampled.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SampleError<E = Infallible> {
    /// The range has no inside, or a kink lies outside it.
    #[error("a range needs two finite ends, the lower one first, with all kinks between them")]
    Range,
    /// The function itself failed.
    #[error("{0}")]
    Function(E),
    /// It gave other than one number for each argument.
    #[error("{given} values came back for {asked} arguments")]
    Count {
        /// Arguments.
        asked: usize,
        /// Values.
        given: usize,
    },
    /// Some values are infinite or no numbers.
    #[error("the value at {at} is {value}")]
    NotFinite {
        /// The argument nearest to zero.
        at: f64,
        /// The value there.
        value: f64,
    },
    /// It bends or jumps where no kink was told.
    #[error("it bends or jumps near {at:?}")]
    Rough {
        /// Where, ascending.
        at: Vec<f64>,
    },
    /// It has too fine a structure.
    #[error("it would take more than {MOST} polynomials")]
    TooFine,
}

/// Samples `function` over `range`, `kinks` being where its slope may jump.
///
/// Every polynomial meets it to about 1e-13 of its largest value there. An odd function over an even
/// range is sampled on one side.
///
/// # Errors
/// [`SampleError`].
pub fn sampled<E>(
    function: impl FnMut(&[f64]) -> Result<Vec<f64>, E>,
    (from, to): (f64, f64),
    kinks: &[f64],
) -> Result<Sampled, SampleError<E>> {
    let inside = |kink: &f64| from < *kink && *kink < to;
    if !(from.is_finite() && to.is_finite() && from < to && kinks.iter().all(inside)) {
        return Err(SampleError::Range);
    }
    let mut marks = [&[from, to], kinks].concat();
    marks.sort_by(f64::total_cmp);
    marks.dedup();
    let mut sampler = Sampler {
        function,
        narrowest: NARROWEST * (to - from),
        evaluations: 0,
        rough: Vec::new(),
        found: Vec::new(),
    };
    let even = marks.iter().zip(marks.iter().rev()).all(|(a, b)| *a == -*b);
    if even && sampler.is_odd(to)? {
        let above: Vec<f64> = marks.iter().copied().filter(|mark| *mark > 0.0).collect();
        let first = if marks.contains(&0.0) { 0.0 } else { -above[0] };
        sampler.all(&[&[first], above.as_slice()].concat(), true)?;
        sampler.bends(&above);
        sampler.mirror();
    } else {
        sampler.all(&marks, false)?;
        sampler.bends(&marks);
    }
    sampler.finished()
}

/// A piece with its ends.
type Part = (f64, f64, Polynomial);

struct Sampler<F> {
    function: F,
    narrowest: f64,
    evaluations: usize,
    /// Where it is not smooth.
    rough: Vec<f64>,
    /// Ascending.
    found: Vec<Part>,
}

impl<E, F: FnMut(&[f64]) -> Result<Vec<f64>, E>> Sampler<F> {
    fn values(&mut self, points: &[f64]) -> Result<Vec<f64>, SampleError<E>> {
        self.evaluations += points.len();
        let values = (self.function)(points).map_err(SampleError::Function)?;
        if values.len() != points.len() {
            return Err(SampleError::Count { asked: points.len(), given: values.len() });
        }
        let strange = points.iter().zip(&values).filter(|(_, value)| !value.is_finite());
        match strange.min_by(|(a, _), (b, _)| a.abs().total_cmp(&b.abs())) {
            Some((at, value)) => Err(SampleError::NotFinite { at: *at, value: *value }),
            None => Ok(values),
        }
    }

    /// Whether the values on both sides of zero are opposite.
    fn is_odd(&mut self, to: f64) -> Result<bool, SampleError<E>> {
        let points = chebyshev::points(-to, to);
        let values = self.values(&points)?;
        let largest = values.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
        let opposite = |(a, b): (&f64, &f64)| (a + b).abs() <= ODD * largest;
        Ok(values.iter().zip(values.iter().rev()).all(opposite))
    }

    /// Takes all parts between the marks.
    fn all(&mut self, marks: &[f64], odd: bool) -> Result<(), SampleError<E>> {
        for pair in marks.windows(2) {
            let mut waiting = vec![(pair[0], pair[1])];
            while let Some((from, to)) = waiting.pop() {
                let middle = odd && from == -to;
                let fitted = self.part(from, to, middle)?;
                let too_fine = self.found.len() + waiting.len() >= MOST;
                match fitted {
                    Some(polynomial) => self.found.push((from, to, polynomial)),
                    None if to - from < self.narrowest => self.is_rough(f64::midpoint(from, to)),
                    None if self.rough.len() >= TOLD => return Ok(()),
                    None if too_fine && self.rough.is_empty() => return Err(SampleError::TooFine),
                    None if from < 0.0 && to > 0.0 => {
                        let near = ABOUT_ZERO * to.min(-from);
                        waiting.extend([(near, to), (-near, near)]);
                        // The other side of an odd function is made from this one.
                        waiting.extend((!middle).then_some((from, -near)));
                    }
                    None => {
                        let cut = f64::midpoint(from, to);
                        waiting.extend([(cut, to), (from, cut)]);
                    }
                }
            }
        }
        Ok(())
    }

    fn part(
        &mut self,
        from: f64,
        to: f64,
        odd: bool,
    ) -> Result<Option<Polynomial>, SampleError<E>> {
        let points = chebyshev::points(from, to);
        let mut values = self.values(&points)?;
        if odd {
            let middle = points.len() / 2;
            values[middle] = 0.0;
            for k in 0..middle {
                values[k] = -values[points.len() - 1 - k];
            }
        }
        Ok(chebyshev::fitted(from, to, &values))
    }

    /// Neighbours of a place that has been told are the same place.
    fn is_rough(&mut self, at: f64) {
        if self.rough.iter().all(|known| (known - at).abs() > 4.0 * self.narrowest) {
            self.rough.push(at);
        }
    }

    /// Tells kinks that a cut fell upon by chance.
    fn bends(&mut self, marks: &[f64]) {
        for index in 1..self.found.len() {
            let [(_, at, before), (_, _, here)] = &self.found[index - 1..=index] else { continue };
            let at = *at;
            let halves = [index - 1, index].map(|k| 0.5 * (self.found[k].1 - self.found[k].0));
            let (value, left) = before.evaluate_with_slope(halves[0]);
            let right = here.evaluate_with_slope(-halves[1]).1;
            let size = value.abs() / halves[0].min(halves[1]) + left.abs() + right.abs();
            if !marks.contains(&at) && (right - left).abs() > BEND * size {
                self.is_rough(at);
            }
        }
        self.rough.sort_by(f64::total_cmp);
    }

    /// Adds the parts below zero of an odd function.
    fn mirror(&mut self) {
        let mirrored = |(from, to, torque): &Part| {
            let mut coefficients = torque.coefficients().to_vec();
            coefficients.iter_mut().step_by(2).for_each(|c| *c = -*c);
            (-to, -from, Polynomial::new(coefficients))
        };
        let sides = self.found.iter().filter(|(from, ..)| *from >= 0.0);
        let below: Vec<Part> = sides.rev().map(mirrored).collect();
        self.found.splice(0..0, below);
        let images: Vec<f64> = self.rough.iter().rev().map(|at| -at).collect();
        self.rough.splice(0..0, images);
        self.rough.dedup_by(|a, b| (*a - *b).abs() <= 4.0 * self.narrowest);
    }

    fn finished(self) -> Result<Sampled, SampleError<E>> {
        if !self.rough.is_empty() {
            return Err(SampleError::Rough { at: self.rough });
        }
        let straight = |x: f64, (from, to, torque): &Part| {
            let (value, slope) = torque.evaluate_with_slope(x - f64::midpoint(*from, *to));
            (x, Polynomial::new([value, slope]))
        };
        let (Some(first), Some(last)) = (self.found.first(), self.found.last()) else {
            return Err(SampleError::Range);
        };
        let (first, last) = (straight(first.0, first), straight(last.1, last));
        let starts = self.found.iter().map(|(from, ..)| *from);
        let breaks = starts.chain([last.0]).collect();
        let inner = self.found.into_iter().map(|(from, to, t)| (f64::midpoint(from, to), t));
        let pieces = [first].into_iter().chain(inner).chain([last]).collect();
        Ok(Sampled { breaks, pieces, evaluations: self.evaluations })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(
        function: impl Fn(f64) -> f64,
        range: (f64, f64),
        kinks: &[f64],
    ) -> Result<Sampled, SampleError> {
        sampled(|points| Ok(points.iter().map(|x| function(*x)).collect()), range, kinks)
    }

    fn value(sampled: &Sampled, x: f64) -> f64 {
        let (origin, piece) = &sampled.pieces[sampled.breaks.partition_point(|end| *end < x)];
        piece.evaluate(x - origin)
    }

    fn is_met(function: impl Fn(f64) -> f64, range: (f64, f64), kinks: &[f64]) -> Sampled {
        let found = of(&function, range, kinks).expect("smooth between its kinks");
        for k in 0..=1000 {
            let x = range.0 + (range.1 - range.0) * f64::from(k) / 1000.0;
            let error = (value(&found, x) - function(x)).abs();
            let at = found.breaks.partition_point(|end| *end < x).clamp(1, found.breaks.len() - 1);
            // All of the functions rise.
            let ends = [at - 1, at].map(|end| function(found.breaks[end]).abs());
            assert!(error <= 1e-13 * ends[0].max(ends[1]), "{x}: {error:e}");
        }
        found
    }

    // Source: the functions themselves.
    #[test]
    fn functions_are_met() {
        assert_eq!(is_met(|x| 3.0 * x - 0.5 * x * x * x, (-2.0, 2.0), &[]).pieces.len(), 3);
        is_met(|x| (4.0 * x).sinh(), (-3.0, 3.0), &[]);
        is_met(|x| 2.0 * x + (20.0 * x).atan(), (-1.0, 4.0), &[]);
        is_met(|x| if x < 0.3 { x } else { 0.3 + 4.0 * (x - 0.3) }, (-1.0, 1.0), &[0.3]);
        is_met(|x| (x.abs() - 0.1).max(0.0) * x.signum(), (-1.0, 1.0), &[-0.1, 0.1]);
    }

    // Source: symmetry.
    #[test]
    fn an_odd_function_is_odd_to_the_last_bit() {
        let found = is_met(|x| x + (5.0 * x).tanh(), (-2.0, 2.0), &[]);
        assert!(found.pieces.len() > 3);
        for k in 0..100 {
            let x = f64::from(k) * 0.03;
            assert_eq!(value(&found, -x), -value(&found, x));
        }
    }

    #[test]
    fn it_goes_on_straight_with_the_slope_of_its_end() {
        // Source: by hand: x³ has slope 12 at 2.
        let found = of(|x| x * x * x, (-2.0, 2.0), &[]).expect("a polynomial");
        assert!((value(&found, 3.0) - 20.0).abs() < 1e-12);
        assert!((value(&found, -3.0) + 20.0).abs() < 1e-12);
    }

    #[test]
    fn what_is_wrong_is_told_with_its_place() {
        let kinked = |x: f64| (x - 0.25).abs() + (x + 0.5).abs();
        let Err(SampleError::Rough { at }) = of(kinked, (-1.0, 1.0), &[]) else {
            panic!("two kinks are not smooth")
        };
        assert_eq!(at.len(), 2);
        assert!((at[0] + 0.5).abs() < 1e-6 && (at[1] - 0.25).abs() < 1e-6, "{at:?}");
        let root = of(|x| (1.0 - x * x).sqrt(), (-2.0, 2.0), &[]);
        assert!(matches!(root, Err(SampleError::NotFinite { at, .. }) if at.abs() > 1.0));
        assert_eq!(of(|x| x, (1.0, -1.0), &[]), Err(SampleError::Range));
        assert_eq!(of(|x| x, (-1.0, 1.0), &[2.0]), Err(SampleError::Range));
        assert_eq!(of(|x| (1e5 * x).sin(), (-1.0, 1.0), &[]), Err(SampleError::TooFine));
        let short = sampled(|_| Ok::<_, Infallible>(vec![0.0]), (-1.0, 1.0), &[]);
        assert!(matches!(short, Err(SampleError::Count { given: 1, .. })));
        let failed = sampled(|_| Err("tired"), (-1.0, 1.0), &[]);
        assert_eq!(failed, Err(SampleError::Function("tired")));
    }
}
