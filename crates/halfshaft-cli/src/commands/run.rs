//! `run`: a study file.

use halfshaft::model::study::read_study;
use halfshaft::{Answer, run_study};

use super::{deliver, target};
use crate::args::Run;
use crate::failure::Failure;
use crate::watch::Watch;

/// Asks all questions of a study.
pub fn run(run: &Run, watch: &Watch) -> Result<(), Failure> {
    let common = &run.common;
    if !common.settings.is_empty() {
        return Err(Failure::Input {
            message: "a study brings its own settings; --set does not reach into it".to_owned(),
            advice: Some("put set = [\"ADDRESS=VALUE\"] into its questions".to_owned()),
        });
    }
    let study = read_study(&run.study)?;
    let target = target(common, "run")?;
    let answer = Answer::Study(run_study(&study, watch));
    deliver(&answer, target.as_ref(), common, watch)
}
