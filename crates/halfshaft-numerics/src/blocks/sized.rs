//! Work on blocks whose order the compiler knows where they are small.

/// Work on blocks of order `M` with one border, where `R` is `M + 1`, the order of the last block with
/// it; on any blocks where both are 0.
pub(super) trait Work {
    type Output;
    fn run<const M: usize, const R: usize>(self) -> Self::Output;
}

/// Work on blocks of one order, as what runs with the widest instructions of the processor.
struct OfOrder<W, const M: usize, const R: usize>(W);

impl<W: Work, const M: usize, const R: usize> pulp::NullaryFnOnce for OfOrder<W, M, R> {
    type Output = W::Output;

    #[inline(always)]
    fn call(self) -> Self::Output {
        self.0.run::<M, R>()
    }
}

/// Does work on blocks of an order, which is known to the compiler where blocks are small.
pub(super) fn sized<W: Work>(order: usize, work: W) -> W::Output {
    let arch = pulp::Arch::new();
    match order {
        2 => arch.dispatch(OfOrder::<W, 2, 3>(work)),
        3 => arch.dispatch(OfOrder::<W, 3, 4>(work)),
        4 => arch.dispatch(OfOrder::<W, 4, 5>(work)),
        6 => arch.dispatch(OfOrder::<W, 6, 7>(work)),
        7 => arch.dispatch(OfOrder::<W, 7, 8>(work)),
        8 => arch.dispatch(OfOrder::<W, 8, 9>(work)),
        9 => arch.dispatch(OfOrder::<W, 9, 10>(work)),
        10 => arch.dispatch(OfOrder::<W, 10, 11>(work)),
        12 => arch.dispatch(OfOrder::<W, 12, 13>(work)),
        _ => arch.dispatch(OfOrder::<W, 0, 0>(work)),
    }
}
