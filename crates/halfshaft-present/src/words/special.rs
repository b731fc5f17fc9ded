//! What special points are called, and what happens there.

use halfshaft_results::SpecialKind;

/// The kind of a special point in words.
pub(crate) fn special_words(kind: SpecialKind) -> &'static str {
    match kind {
        SpecialKind::Fold => "fold",
        SpecialKind::PeriodDoubling => "period doubling",
        SpecialKind::NeimarkSacker => "Neimark-Sacker (torus)",
        SpecialKind::BranchPoint => "branch point",
        SpecialKind::GrazingContact => "grazing contact",
        SpecialKind::Cusp => "cusp",
        SpecialKind::IsolaBirth => "birth of a detached response",
        SpecialKind::IsolaMerger => "merger of a detached response",
        SpecialKind::End => "end",
    }
}

/// What happens at points of that kind, as a sentence; empty for ends, which explain themselves.
pub(crate) fn special_explanation(kind: SpecialKind) -> &'static str {
    match kind {
        SpecialKind::Fold => "At a fold two responses meet and vanish: a slow sweep jumps there.",
        SpecialKind::PeriodDoubling => {
            "At a period doubling a response begins that repeats only every second period of the \
             excitation."
        }
        SpecialKind::NeimarkSacker => {
            "At a Neimark-Sacker point the response begins to beat: a second, slower rhythm is added \
             that has no common period with the excitation."
        }
        SpecialKind::BranchPoint => "At a branch point two responses cross.",
        SpecialKind::GrazingContact => {
            "At a grazing contact the twist just reaches a place where the law of a shaft changes."
        }
        SpecialKind::Cusp => {
            "A cusp is where two folds meet and vanish: the threshold of the jump."
        }
        SpecialKind::IsolaBirth => {
            "A detached response is one that no slow sweep reaches; at its birth it is a single point."
        }
        SpecialKind::IsolaMerger => {
            "At its merger it joins another response, and sweeps reach it from then on."
        }
        SpecialKind::End => "",
    }
}
