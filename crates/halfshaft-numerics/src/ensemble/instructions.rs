//! Which instructions of the processor a batch is computed with, chosen while the program runs.

/// A set of vector instructions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Instructions {
    /// What every processor of the kind has.
    Plain,
    /// AVX2 with fused multiply-add: registers of four numbers.
    Avx2,
    /// AVX-512: registers of eight numbers.
    Avx512,
}

/// Work that can be done with any instructions.
pub(super) trait Job {
    /// What comes out.
    type Output;

    /// Does it; always inlined into code of the wanted instructions.
    fn run(self) -> Self::Output;
}

/// A job as `pulp` takes it: a structure and no closure, because only that is sure to be compiled with
/// the instructions.
#[cfg(target_arch = "x86_64")]
struct Inside<J>(J);

#[cfg(target_arch = "x86_64")]
impl<J: Job> pulp::NullaryFnOnce for Inside<J> {
    type Output = J::Output;

    #[inline(always)]
    fn call(self) -> J::Output {
        self.0.run()
    }
}

impl Instructions {
    /// All sets that this processor has, the widest last.
    pub fn available() -> Vec<Self> {
        [Self::Plain, Self::Avx2, Self::Avx512].into_iter().filter(|set| set.exists()).collect()
    }

    /// The widest set that this processor has.
    pub fn best() -> Self {
        [Self::Avx512, Self::Avx2].into_iter().find(|set| set.exists()).unwrap_or(Self::Plain)
    }

    /// Numbers in a register of this set, or a bundle of registers that keeps the processor busy.
    pub fn lanes(self) -> usize {
        match self {
            Self::Plain => 4,
            Self::Avx2 => 8,
            Self::Avx512 => 16,
        }
    }

    #[cfg(target_arch = "x86_64")]
    fn exists(self) -> bool {
        match self {
            Self::Plain => true,
            Self::Avx2 => pulp::x86::V3::try_new().is_some(),
            Self::Avx512 => pulp::x86::V4::try_new().is_some(),
        }
    }

    #[cfg(not(target_arch = "x86_64"))]
    fn exists(self) -> bool {
        self == Self::Plain
    }

    /// Does a job with these instructions, or with plain ones where the processor has them not.
    #[inline]
    pub(super) fn run<J: Job>(self, job: J) -> J::Output {
        #[cfg(target_arch = "x86_64")]
        {
            if self == Self::Avx512
                && let Some(simd) = pulp::x86::V4::try_new()
            {
                return simd.vectorize(Inside(job));
            }
            if self == Self::Avx2
                && let Some(simd) = pulp::x86::V3::try_new()
            {
                return simd.vectorize(Inside(job));
            }
        }
        job.run()
    }
}
