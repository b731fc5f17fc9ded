//! What to ask next.

use halfshaft_results::{Answer, HistoryResult, ResonanceResult, StaticResult};

use crate::reading::{Method, Reading};

/// A hint at the question that usually follows.
pub(crate) fn next(answer: &Answer) -> Option<String> {
    let hint = match answer {
        Answer::Check(_) => {
            "`halfshaft static` for the wind-up and what the shafts carry, `halfshaft modes` for \
             natural frequencies, `halfshaft report` for everything on one page"
        }
        Answer::Static(result) => after_static(result),
        Answer::Modes(_) => {
            "`halfshaft resonance` for the vibration under the oscillating torques, `halfshaft \
             shock` for the answer to a load pulse"
        }
        Answer::Campbell(_) => {
            "`halfshaft forced` for the torques and accelerations at these speeds"
        }
        Answer::Forced(_) => {
            "`--shaft NAME` and `--node NAME` for every order of one of them, `halfshaft campbell` for \
             which modes the peaks belong to"
        }
        Answer::History(result) => after_history(result)?,
        Answer::Resonance(result) => return Some(after_resonance(result)),
        Answer::Folds(_) => {
            "`halfshaft resonance --set \"ADDRESS=VALUE\"` for the response at a point of this plane"
        }
        Answer::Basins(_) => {
            "`halfshaft resonance` for these responses over the speed, and where each of them ends"
        }
        Answer::Bifurcation(_) => {
            "`halfshaft basins` at one of these speeds for which initial state leads where"
        }
        Answer::Study(_) => return None,
        Answer::Report(report) => {
            let shaft = report.check.shafts.first().map_or("SHAFT", |shaft| shaft.name.as_str());
            return Some(format!(
                "change a value and ask again, for instance `halfshaft static --set \
                 \"{}.stiffness=VALUE\"`",
                crate::words::plain(shaft)
            ));
        }
    };
    Some(hint.to_owned())
}

fn after_static(result: &StaticResult) -> &'static str {
    if result.equilibria.iter().any(|state| state.stable) {
        "`halfshaft modes` for the natural frequencies about this state"
    } else {
        "lower the mean torques, take another gear or a stiffer shaft with --set \"ADDRESS=VALUE\""
    }
}

fn after_history(result: &HistoryResult) -> Option<&'static str> {
    let shock = result.shock.as_ref()?;
    // Other methods are for one shaft between two inertias.
    let fits = result.metrics.shafts.len() == 1;
    (fits && shock.comparison.is_empty()).then_some(
        "`--compare` sets the other methods beside this one, `--out shock.html` shows the figures",
    )
}

fn after_resonance(result: &ResonanceResult) -> String {
    let checked = !result.verification.is_empty();
    let check = if !checked && Reading::of(result).method != Method::FirstHarmonic {
        "`--verify` to hold this against integration of the full equations, "
    } else {
        ""
    };
    let channel = result.leading_channel().unwrap_or_default();
    let damping = channel.strip_suffix(".twist").map_or_else(
        || "ADDRESS=A..B".to_owned(),
        |shaft| format!("{}.damping=A..B", crate::words::plain(shaft)),
    );
    format!("{check}`halfshaft folds --parameter \"{damping}\"` for where the response folds")
}
