//! Which orders a truncated Fourier series has, and where their coefficients stand.

use std::sync::Arc;

/// Orders of a truncated Fourier series, ascending; order 0 is the mean.
#[derive(Debug, Clone)]
pub struct HarmonicSet {
    /// Shared: each of the responses of a branch has its own copy of the set.
    orders: Arc<[usize]>,
}

impl PartialEq for HarmonicSet {
    fn eq(&self, other: &Self) -> bool {
        // Either all orders or the odd ones, so that kind and number tell.
        self.is_odd() == other.is_odd() && self.orders.len() == other.orders.len()
    }
}

impl Eq for HarmonicSet {}

impl HarmonicSet {
    /// The mean and every order up to `highest`.
    pub fn all(highest: usize) -> Self {
        Self { orders: (0..=highest).collect() }
    }

    /// The odd orders up to `highest`, for signals with `x(θ + π) = -x(θ)`.
    pub fn odd(highest: usize) -> Self {
        Self { orders: (1..=highest.max(1)).step_by(2).collect() }
    }

    /// The same kind of set with another highest order.
    #[must_use]
    pub fn up_to(&self, highest: usize) -> Self {
        if self.is_odd() { Self::odd(highest) } else { Self::all(highest) }
    }

    /// Whether the set has odd orders only.
    pub fn is_odd(&self) -> bool {
        self.orders.first() != Some(&0)
    }

    /// The orders, ascending.
    pub fn orders(&self) -> &[usize] {
        &self.orders
    }

    /// The highest order.
    pub fn highest(&self) -> usize {
        self.orders.last().copied().unwrap_or(0)
    }

    /// Number of real coefficients.
    pub fn coefficients(&self) -> usize {
        2 * self.orders.len() - usize::from(!self.is_odd())
    }

    /// Place of the cosine coefficient of the order at `index`; that of the sine follows it, except
    /// for the mean, which has none.
    #[inline]
    pub fn place(&self, index: usize) -> usize {
        if self.is_odd() { 2 * index } else { (2 * index).saturating_sub(1) }
    }

    /// Place of the cosine coefficient of `order`, if the set has it.
    pub fn place_of(&self, order: usize) -> Option<usize> {
        self.orders.binary_search(&order).ok().map(|index| self.place(index))
    }

    /// Each order with the place of its cosine coefficient.
    pub fn places(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.orders.iter().enumerate().map(|(index, order)| (*order, self.place(index)))
    }

    /// Copies the coefficients of a series over `from` into one over this set, whose order `factor j`
    /// is order `j` of `from`; what this set lacks is dropped, what `from` lacks is zero.
    pub fn take(&self, from: &Self, factor: usize, source: &[f64], target: &mut [f64]) {
        target.fill(0.0);
        if factor == 1 && self.is_odd() == from.is_odd() {
            let shared = source.len().min(target.len());
            target[..shared].copy_from_slice(&source[..shared]);
            return;
        }
        for (order, place) in from.places() {
            let Some(to) = self.place_of(factor * order) else { continue };
            target[to] = source[place];
            if order > 0 {
                target[to + 1] = source[place + 1];
            }
        }
    }

    /// The series at phase `theta`: value and derivative by the phase.
    pub fn evaluate(&self, coefficients: &[f64], theta: f64) -> (f64, f64) {
        let (mut value, mut slope) = (0.0, 0.0);
        // Powers of exp(iθ): one sine and cosine for all orders.
        let (sin1, cos1) = theta.sin_cos();
        let (mut sin, mut cos, mut at) = (0.0, 1.0, 0);
        for (order, place) in self.places() {
            while at < order {
                (sin, cos) = (sin * cos1 + cos * sin1, cos * cos1 - sin * sin1);
                at += 1;
            }
            if order == 0 {
                value += coefficients[place];
                continue;
            }
            let (a, b) = (coefficients[place], coefficients[place + 1]);
            value += a * cos + b * sin;
            slope += order as f64 * (b * cos - a * sin);
        }
        (value, slope)
    }

    /// Modulus of the harmonic of `order`; zero where the set lacks it.
    pub fn modulus(&self, coefficients: &[f64], order: usize) -> f64 {
        match self.place_of(order) {
            Some(place) if order == 0 => coefficients[place].abs(),
            Some(place) => coefficients[place].hypot(coefficients[place + 1]),
            None => 0.0,
        }
    }
}
