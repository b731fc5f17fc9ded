//! Several numbers that are computed with at once: 1, 4, 8, 16 or 32 lanes.
//!
//! Every operation is one IEEE operation per lane, and products with sums are fused only where
//! [`Lanes::mul_add`] says so: the compiler never fuses by itself. So a lane's result does not depend
//! on how many lanes there are, nor on the instructions of the processor. (On a processor without
//! fused multiply-add the C library computes it: the same result, slowly.)
//!
//! The loops over the lanes have a known count and no branch, which the compiler turns into vector
//! instructions inside [`Instructions::run`](super::Instructions::run).

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Numbers side by side, one for each trajectory of a batch.
pub trait Lanes:
    Copy
    + Debug
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + 'static
{
    /// How many.
    const COUNT: usize;

    /// The same number in every lane.
    fn splat(value: f64) -> Self;

    /// The number in one lane.
    fn get(&self, lane: usize) -> f64;

    /// Sets the number in one lane.
    fn set(&mut self, lane: usize, value: f64);

    /// One function for every lane.
    fn map(self, function: impl Fn(f64) -> f64) -> Self;

    /// One function of two numbers for every lane.
    fn zip(self, other: Self, function: impl Fn(f64, f64) -> f64) -> Self;

    /// `self · factor + term`, rounded once.
    fn mul_add(self, factor: Self, term: Self) -> Self;

    /// Whether the test holds in any lane.
    fn any(self, other: Self, test: impl Fn(f64, f64) -> bool) -> bool;

    /// `yes` where the test of `self` and `other` holds, else `no`.
    fn select(self, other: Self, test: impl Fn(f64, f64) -> bool, yes: Self, no: Self) -> Self;

    /// Magnitude.
    #[inline(always)]
    fn abs(self) -> Self {
        self.map(f64::abs)
    }

    /// Square root.
    #[inline(always)]
    fn sqrt(self) -> Self {
        self.map(f64::sqrt)
    }

    /// The larger one; `other` where `self` is not a number.
    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        self.zip(other, |a, b| if a > b { a } else { b })
    }

    /// The smaller one; `other` where `self` is not a number.
    #[inline(always)]
    fn smaller(self, other: Self) -> Self {
        self.zip(other, |a, b| if a < b { a } else { b })
    }
}

/// A width with the alignment of its registers.
macro_rules! lanes {
    ($name:ident, $count:literal, $align:literal, $doc:literal) => {
        #[doc = $doc]
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[repr(C, align($align))]
        pub struct $name([f64; $count]);

        impl Lanes for $name {
            const COUNT: usize = $count;

            #[inline(always)]
            fn splat(value: f64) -> Self {
                Self([value; $count])
            }

            #[inline(always)]
            fn get(&self, lane: usize) -> f64 {
                self.0[lane]
            }

            #[inline(always)]
            fn set(&mut self, lane: usize, value: f64) {
                self.0[lane] = value;
            }

            #[inline(always)]
            fn map(mut self, function: impl Fn(f64) -> f64) -> Self {
                for lane in 0..$count {
                    self.0[lane] = function(self.0[lane]);
                }
                self
            }

            #[inline(always)]
            fn zip(mut self, other: Self, function: impl Fn(f64, f64) -> f64) -> Self {
                for lane in 0..$count {
                    self.0[lane] = function(self.0[lane], other.0[lane]);
                }
                self
            }

            #[inline(always)]
            fn mul_add(mut self, factor: Self, term: Self) -> Self {
                for lane in 0..$count {
                    self.0[lane] = self.0[lane].mul_add(factor.0[lane], term.0[lane]);
                }
                self
            }

            #[inline(always)]
            fn any(self, other: Self, test: impl Fn(f64, f64) -> bool) -> bool {
                let mut found = false;
                for lane in 0..$count {
                    found |= test(self.0[lane], other.0[lane]);
                }
                found
            }

            #[inline(always)]
            fn select(
                self,
                other: Self,
                test: impl Fn(f64, f64) -> bool,
                mut yes: Self,
                no: Self,
            ) -> Self {
                for lane in 0..$count {
                    let holds = test(self.0[lane], other.0[lane]);
                    yes.0[lane] = if holds { yes.0[lane] } else { no.0[lane] };
                }
                yes
            }
        }

        lanes!(operator $name, $count, Add, add, +=);
        lanes!(operator $name, $count, Sub, sub, -=);
        lanes!(operator $name, $count, Mul, mul, *=);
        lanes!(operator $name, $count, Div, div, /=);

        impl Neg for $name {
            type Output = Self;

            #[inline(always)]
            fn neg(self) -> Self {
                self.map(|value| -value)
            }
        }
    };
    (operator $name:ident, $count:literal, $trait:ident, $method:ident, $sign:tt) => {
        impl $trait for $name {
            type Output = Self;

            #[inline(always)]
            fn $method(mut self, other: Self) -> Self {
                for lane in 0..$count {
                    self.0[lane] $sign other.0[lane];
                }
                self
            }
        }
    };
}

lanes!(One, 1, 8, "One lane.");
lanes!(Four, 4, 32, "Four lanes: a register of AVX2.");
lanes!(Eight, 8, 64, "Eight lanes: a register of AVX-512, two of AVX2.");
lanes!(Sixteen, 16, 64, "Sixteen lanes: four registers of AVX2, two of AVX-512.");
lanes!(ThirtyTwo, 32, 64, "Thirty-two lanes: four registers of AVX-512.");
