//! The first time at which a polynomial of time leaves one side of a level, for certain.
//!
//! In Bernstein form over an interval a polynomial lies within the range of its coefficients, and has
//! at most as many roots as its coefficients change signs (G. Farin, *Curves and Surfaces for CAGD*,
//! chapter 6). Halving the interval by de Casteljau's rule thus finds the first root or proves that
//! there is none, however near to touching the motion comes. Most motions that leave do so straight on:
//! where the slope is negative for sure up to beyond the root, Newton's method has it at once.

use super::horner::value_and_slope;

/// Coefficients of a polynomial over an interval, in Bernstein form.
type Form = Vec<f64>;

/// Halvings at most: a root that two crossings share within this part of a step is none.
const DEEPEST: usize = 42;
/// Iterations of the search once there is one root for sure.
const MOST_ITERATIONS: usize = 80;

/// The first `t` in `[0, step]` from which on `sign · (x(t) - level)` is negative, with `x` given by its
/// coefficients, ascending, at least two; `entered` says that it is zero at 0 and that this zero is not
/// meant.
pub fn first_exit(x: &[f64], step: f64, level: f64, sign: f64, entered: bool) -> Option<f64> {
    let skipped = usize::from(entered);
    let mut power = sign;
    let mut sum = 0.0;
    let mut scaled: Vec<f64> = Vec::with_capacity(x.len());
    for (at, c) in x.iter().enumerate().skip(skipped) {
        let value = if at == 0 { sign * (c - level) } else { power * c };
        if !scaled.is_empty() {
            sum += value.abs();
        }
        scaled.push(value);
        power *= step;
    }
    // Most steps end here: nowhere near the level.
    if scaled.first().is_none_or(|first| *first > sum) {
        return None;
    }
    if let Some(part) = straight_on(&scaled) {
        return part.map(|part| part * step);
    }
    let form = bernstein(&scaled);
    let part = search(&form, 0.0, 1.0, 0)?;
    Some(part * step)
}

/// The only root in `[0, 1]` of a polynomial in powers that falls all the way to it, or that there is
/// none since it rises, or falls to the end and stays positive; `None` where neither is certain.
fn straight_on(powers: &[f64]) -> Option<Option<f64>> {
    let [start, slope, rest @ ..] = powers else { return None };
    let rises = *slope > 0.0 && *start >= 0.0;
    let guess = -start / slope;
    if !(rises || guess > 0.0 && *start > 0.0) {
        return None;
    }
    let end = if rises { 1.0 } else { (2.0 * guess).min(1.0) };
    let terms = rest.iter().enumerate().rev();
    let bend = terms.fold(0.0, |sum, (k, c)| sum * end + (k + 2) as f64 * c.abs()) * end;
    if bend >= slope.abs() {
        return None;
    }
    if rises {
        return Some(None);
    }
    if value_and_slope(powers, end).0 >= 0.0 {
        return (end == 1.0).then_some(None);
    }
    Some(Some(bracketed(end, guess.min(end), |at| value_and_slope(powers, at))))
}

/// The only root in `(0, high)` of what begins positive and ends negative, from a guess: Newton's steps,
/// or halvings where these leave the bracket.
fn bracketed(mut high: f64, guess: f64, function: impl Fn(f64) -> (f64, f64)) -> f64 {
    let (mut low, mut at) = (0.0, guess);
    for _ in 0..MOST_ITERATIONS {
        let (value, slope) = function(at);
        if value < 0.0 {
            high = at;
        } else {
            low = at;
        }
        let newton = at - value / slope;
        let next = if newton > low && newton < high { newton } else { f64::midpoint(low, high) };
        let moved = (next - at).abs();
        at = next;
        if moved <= f64::EPSILON {
            break;
        }
    }
    at
}

/// Bernstein coefficients over `[0, 1]` of a polynomial in powers.
fn bernstein(powers: &[f64]) -> Form {
    let degree = powers.len() - 1;
    // b_i = Σ_k C(i, k) / C(n, k) a_k, row by row of sums: a_k / C(n, k) summed like Pascal's triangle.
    let mut form: Form = powers.to_vec();
    let mut choose = 1.0;
    for (k, value) in form.iter_mut().enumerate() {
        *value /= choose;
        choose *= (degree - k) as f64 / (k + 1) as f64;
    }
    for round in 1..=degree {
        for at in (round..=degree).rev() {
            form[at] += form[at - 1];
        }
    }
    form
}

/// The first root with a change to negative, as a part of the whole interval.
fn search(form: &Form, low: f64, high: f64, depth: usize) -> Option<f64> {
    if form[0] < 0.0 {
        return Some(low);
    }
    if form.iter().all(|b| *b >= 0.0) {
        return None;
    }
    let last = form[form.len() - 1];
    if last < 0.0 && changes(form) == 1 {
        return Some(low + (high - low) * single(form));
    }
    if depth >= DEEPEST {
        return (last < 0.0).then_some(high);
    }
    let (left, right) = halves(form);
    let middle = f64::midpoint(low, high);
    search(&left, low, middle, depth + 1).or_else(|| search(&right, middle, high, depth + 1))
}

/// Changes of sign, zeros left out.
fn changes(form: &Form) -> usize {
    let signs = form.iter().filter(|b| **b != 0.0).map(|b| *b > 0.0);
    let mut count = 0;
    let mut before = None;
    for sign in signs {
        count += usize::from(before.is_some_and(|known| known != sign));
        before = Some(sign);
    }
    count
}

/// The only root in `(0, 1)` of a form that begins positive and ends negative.
fn single(form: &Form) -> f64 {
    let guess = form[0] / (form[0] - form[form.len() - 1]);
    bracketed(1.0, guess, |at| evaluate(form, at))
}

/// Value and slope by de Casteljau's rule.
fn evaluate(form: &Form, at: f64) -> (f64, f64) {
    let degree = form.len() - 1;
    let mut row = form.clone();
    for length in (2..=degree).rev() {
        for k in 0..length {
            row[k] += at * (row[k + 1] - row[k]);
        }
    }
    if degree == 0 {
        return (row[0], 0.0);
    }
    // Two values are left to be mixed: their difference is the slope over the degree.
    let change = row[1] - row[0];
    (row[0] + at * change, degree as f64 * change)
}

/// The form over both halves.
fn halves(form: &Form) -> (Form, Form) {
    let count = form.len();
    let mut row = form.clone();
    let (mut left, mut right) = (Vec::with_capacity(count), vec![0.0; count]);
    for round in 0..count {
        left.push(row[0]);
        right[count - 1 - round] = row[count - 1 - round];
        for k in 0..count - 1 - round {
            row[k] = f64::midpoint(row[k], row[k + 1]);
        }
    }
    (left, right)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn series(coefficients: &[f64]) -> [f64; 21] {
        let mut out = [0.0; 21];
        out[..coefficients.len()].copy_from_slice(coefficients);
        out
    }

    // Source: roots of the polynomials by hand.
    #[test]
    fn first_exits_are_the_first_roots() {
        // (t - 0.25)(t - 0.5): leaves the upper side at 0.25, the lower side at 0.5.
        let x = series(&[0.125, -0.75, 1.0]);
        assert!((first_exit(&x, 1.0, 0.0, 1.0, false).expect("one") - 0.25).abs() < 1e-15);
        assert_eq!(first_exit(&x, 0.2, 0.0, 1.0, false), None);
        assert_eq!(first_exit(&x, 1.0, 0.0, -1.0, false), Some(0.0));
        // Level 2: t² - 1 leaves the lower side at 1.
        let x = series(&[1.0, 0.0, 1.0]);
        assert!((first_exit(&x, 3.0, 2.0, -1.0, false).expect("one") - 1.0).abs() < 1e-15);
        assert_eq!(first_exit(&x, 0.9, 2.0, -1.0, false), None);
    }

    // Source: the general search, which knows nothing of slopes, on polynomials of no pattern.
    #[test]
    fn straight_exits_are_those_of_the_search() {
        let (mut seed, mut straight) = (7_u32, 0);
        let mut random = || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(seed) / f64::from(u32::MAX) - 0.5
        };
        for _ in 0..20_000 {
            let damping = 0.2 + random().abs();
            let mut powers: Vec<f64> =
                (0..12).map(|k: i32| 3.0 * random() * damping.powi(k)).collect();
            powers[0] = powers[0].abs();
            let Some(found) = straight_on(&powers) else { continue };
            let expected = search(&bernstein(&powers), 0.0, 1.0, 0);
            assert_eq!(found.is_some(), expected.is_some(), "{powers:?}");
            if let (Some(found), Some(expected)) = (found, expected) {
                straight += 1;
                assert!((found - expected).abs() < 1e-14, "{found} {expected} {powers:?}");
            }
        }
        assert!(straight > 500, "{straight}");
    }

    // Source: t (1 - t): after it has entered at 0 it leaves at 1; without that knowledge at once.
    #[test]
    fn the_root_just_passed_is_not_found_again() {
        let x = series(&[0.0, 1.0, -1.0]);
        let exit = first_exit(&x, 2.0, 0.0, 1.0, true).expect("one");
        assert!((exit - 1.0).abs() < 1e-15);
        assert_eq!(first_exit(&x, 0.5, 0.0, 1.0, true), None);
        assert_eq!(first_exit(&x, 0.5, 0.0, -1.0, true), Some(0.0));
    }

    // Source: (t - 1/3)² ± e has roots at 1/3 ± sqrt(e), or none.
    #[test]
    fn nearly_touching_is_told_from_touching() {
        for e in [1e-4, 1e-8, 1e-12] {
            let third = 1.0_f64 / 3.0;
            let below = series(&[third * third - e, -2.0 * third, 1.0]);
            let exit = first_exit(&below, 1.0, 0.0, 1.0, false).expect("two roots");
            assert!((exit - (third - e.sqrt())).abs() < 1e-16 / e.sqrt(), "{e}");
            let above = series(&[third * third + e, -2.0 * third, 1.0]);
            assert_eq!(first_exit(&above, 1.0, 0.0, 1.0, false), None, "{e}");
        }
    }
}
