//! The count of roots: stationary points cut the line into monotone pieces.

use super::refine::refine;
use super::{Multiplicity, Polynomial, Root, horner};
use crate::small_list::SmallList;

/// Coefficients kept in place: those of all derivatives of a polynomial of degree 7.
const INLINE_CHAIN: usize = 25;
/// Roots kept in place.
const INLINE_ROOTS: usize = 8;

/// Beyond this value of `4 a c / b²` the linear term of a quadratic is lost in rounding.
const NEGLIGIBLE_LINEAR: f64 = 1e40;

type Chain = SmallList<f64, INLINE_CHAIN>;
type Points = SmallList<f64, INLINE_ROOTS>;

/// A point between two pieces of the line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Node {
    pub(super) x: f64,
    pub(super) value: f64,
    /// Sign of the value; 0 if rounding leaves it open.
    pub(super) sign: i8,
    /// Whether the derivative is zero here.
    pub(super) stationary: bool,
}

/// The roots in `(-bound, bound)` of a polynomial of degree three or more, ascending.
///
/// If roots lie beyond the bound, those close to it may be missed or misplaced.
pub(super) fn roots_within(coefficients: &[f64], bound: f64) -> Vec<Root> {
    let mut chain = Chain::filled(chain_length(coefficients.len()));
    write_derivatives(coefficients, chain.as_mut_slice());
    let mut levels = chain.as_slice();
    let mut stationary = Points::new();
    let mut next = Points::new();
    // From the quadratic derivative upwards: the roots of each are stationary points of the next.
    for length in 3..coefficients.len() {
        let (rest, level) = levels.split_at(levels.len() - length);
        levels = rest;
        next.clear();
        each_root(level, stationary.as_slice(), bound, |root| next.push(root.value));
        std::mem::swap(&mut stationary, &mut next);
    }
    let mut roots = Vec::with_capacity(coefficients.len() - 1);
    each_root(coefficients, stationary.as_slice(), bound, |root| roots.push(root));
    roots
}

/// Coefficients of all derivatives, down to the quadratic one, of a polynomial of `length` ones.
fn chain_length(length: usize) -> usize {
    (3..length).sum()
}

/// Writes the coefficients of the first derivative, the second, ... down to the quadratic one.
fn write_derivatives(coefficients: &[f64], chain: &mut [f64]) {
    let mut from = coefficients;
    let mut rest = chain;
    while from.len() > 3 {
        let (level, others) = rest.split_at_mut(from.len() - 1);
        for (power, (out, c)) in level.iter_mut().zip(&from[1..]).enumerate() {
            *out = c * (power + 1) as f64;
        }
        (from, rest) = (level, others);
    }
}

/// Reports the roots of one level in ascending order, given its stationary points.
fn each_root(level: &[f64], stationary: &[f64], bound: f64, mut report: impl FnMut(Root)) {
    if let [constant, linear, square] = *level {
        quadratic_roots([constant, linear, square], report);
    } else {
        Walk::new(level, bound, &mut report).over(stationary, bound);
    }
}

/// Roots of a quadratic, ascending, by the formula that never subtracts numbers of like size.
pub(super) fn quadratic_roots(coefficients: [f64; 3], mut report: impl FnMut(Root)) {
    let [constant, linear, square] = coefficients;
    // 4 a c / b², which decides without squares that might overflow.
    let ratio = 4.0 * (square / linear) * (constant / linear);
    if (ratio - 1.0).abs() < 0.5 {
        let vertex = node(&coefficients, -0.5 * linear / square, true);
        if vertex.sign == 0 {
            report(Root { value: vertex.x, multiplicity: Multiplicity::Double });
            return;
        }
    }
    let pair = if ratio.abs() < NEGLIGIBLE_LINEAR {
        // NaN if the radicand is negative.
        let q = -0.5 * linear * (1.0 + (1.0 - ratio).sqrt());
        [q / square, constant / q]
    } else if constant == 0.0 {
        [0.0, -linear / square]
    } else if (square < 0.0) != (constant < 0.0) {
        let distance = constant.abs().sqrt() / square.abs().sqrt();
        [-distance, distance]
    } else {
        return;
    };
    if pair[0].is_nan() {
        return;
    }
    for value in [pair[0].min(pair[1]), pair[0].max(pair[1])] {
        report(Root { value, multiplicity: Multiplicity::Simple });
    }
}

fn node(level: &[f64], x: f64, stationary: bool) -> Node {
    let (value, bound) = horner::value_and_bound(level, x);
    // Beyond the range of numbers the sign of the infinity is as good as any.
    let sign = if value.abs() <= Polynomial::ZERO_FACTOR * bound && bound.is_finite() {
        0
    } else if value > 0.0 {
        1
    } else {
        -1
    };
    Node { x, value, sign, stationary }
}

/// An end of the line, where the sign has to be taken as it comes.
fn end_node(level: &[f64], x: f64) -> Node {
    let value = horner::value(level, x);
    Node { x, value, sign: if value < 0.0 { -1 } else { 1 }, stationary: false }
}

/// Goes along the line from node to node and reports the roots on its way.
struct Walk<'a, R: FnMut(Root)> {
    level: &'a [f64],
    /// The last node with a definite sign.
    left: Node,
    /// Nodes since then at which the value is zero within rounding.
    cluster: Option<Cluster>,
    report: &'a mut R,
}

/// Neighbouring nodes between which the value stays zero within rounding.
#[derive(Clone, Copy)]
struct Cluster {
    last: Node,
    best: Node,
}

impl<'a, R: FnMut(Root)> Walk<'a, R> {
    fn new(level: &'a [f64], bound: f64, report: &'a mut R) -> Self {
        Self { level, left: end_node(level, -bound), cluster: None, report }
    }

    /// Visits the stationary points, then the upper end.
    fn over(mut self, stationary: &[f64], bound: f64) {
        for &x in stationary {
            if x > self.here() && x < bound {
                self.visit(node(self.level, x, true));
            }
        }
        let end = end_node(self.level, bound);
        self.visit(end);
    }

    fn here(&self) -> f64 {
        self.cluster.map_or(self.left.x, |cluster| cluster.last.x)
    }

    fn visit(&mut self, node: Node) {
        match (self.cluster, node.sign) {
            (None, 0) => self.cluster = Some(Cluster { last: node, best: node }),
            (None, sign) => {
                if sign != self.left.sign {
                    let value = refine(self.level, self.left, node);
                    (self.report)(Root { value, multiplicity: Multiplicity::Simple });
                }
                self.left = node;
            }
            (Some(cluster), 0) => self.extend(cluster, node),
            (Some(cluster), _) => self.close(cluster, node),
        }
    }

    /// Two neighbours are zero within rounding: one cluster only if the value between them is too.
    fn extend(&mut self, cluster: Cluster, zero: Node) {
        let between = node(self.level, 0.5 * (cluster.last.x + zero.x), false);
        if between.sign == 0 {
            let best =
                if zero.value.abs() < cluster.best.value.abs() { zero } else { cluster.best };
            self.cluster = Some(Cluster { last: zero, best });
        } else {
            self.close(cluster, between);
            self.cluster = Some(Cluster { last: zero, best: zero });
        }
    }

    fn close(&mut self, cluster: Cluster, right: Node) {
        let multiplicity =
            if self.left.sign == right.sign { Multiplicity::Double } else { Multiplicity::Simple };
        (self.report)(Root { value: cluster.best.x, multiplicity });
        self.left = right;
        self.cluster = None;
    }
}
