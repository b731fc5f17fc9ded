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

    /// The numbers of lanes that there is code for: up to as many registers as keep the processor busy
    /// while each result waits for the one before.
    pub fn widths(self) -> &'static [usize] {
        match self {
            Self::Plain => &[1, 4],
            Self::Avx2 => &[1, 4, 8, 16],
            Self::Avx512 => &[8, 16, 32],
        }
    }

    /// These instructions, or narrower ones for few lanes, and the fewest lanes that hold so many
    /// trajectories, or the most there are.
    pub(super) fn for_lanes(self, wanted: usize) -> (Self, usize) {
        let set = if self == Self::Avx512 && wanted < 8 { Self::Avx2 } else { self };
        let widths = set.widths();
        let fits = widths.iter().find(|width| **width >= wanted).or(widths.last());
        (set, fits.copied().unwrap_or(1))
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
