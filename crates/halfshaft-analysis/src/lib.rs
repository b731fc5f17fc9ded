//! The questions halfshaft answers about a driveline.
//!
//! In goes a line and a [`Question`], out comes an [`Answer`] ([`ask`]). One folder a question,
//! all of one shape: the question's settings come from `halfshaft-model`, `solve` turns them into
//! the result. Nothing here knows text or screens.
//!
//! | folder | question | method |
//! |---|---|---|
//! | `check` | is the model sound? | reduced inertias, ratios |
//! | `equilibrium` | `static` | all roots of the torque laws |
//! | `modal` | `modes` | symmetric eigenproblem without the rigid-body motion |
//! | `campbell` | `campbell` | modes over the orders of the excitation |
//! | `forced` | `forced` | dynamic stiffness of the line, order by order |
//! | `time_response` | `simulate` | order 8, dense output, energy balance |
//! | `shock` | `shock` | the same, single equations, multiple scales |
//! | `basins` | `basins` | many motions side by side |
//! | `bifurcation` | `bifurcation` | the motion from value to value, seen once a period |
//! | `averaging` | `resonance`, `folds` | closed form of one mode |
//! | `shooting` | orbits by the motion itself | Taylor series between the kinks of laws |
//! | `verification` | what the full equations say | shooting |

mod averaging;
mod basins;
mod bifurcation;
mod campbell;
mod check;
mod equilibrium;
mod error;
mod first_harmonic;
mod forced;
mod harmonic_balance;
mod header;
mod modal;
mod polynomials_only;
mod shock;
mod shooting;
mod time_response;
mod verification;

use halfshaft_dynamics::EquationsOfMotion;
use halfshaft_model::Driveline;
use halfshaft_model::question::{FoldsQuestion, Question, ResonanceMethod};
use halfshaft_numerics::observer::Observer;
use halfshaft_results::{Answer, ResponseCount};

pub use error::AnalysisError;
#[doc(hidden)]
pub use harmonic_balance::layers;

/// Numbers of periodic responses that coexist, by the first harmonic, at all pairs of excitation
/// speeds (rad/s) and values of the parameter of a question about folds.
///
/// # Errors
/// [`AnalysisError::MethodDoesNotFit`] for a line with several nonlinear shafts.
pub fn response_count(
    line: &Driveline,
    question: &FoldsQuestion,
    speeds: &[f64],
    parameters: &[f64],
) -> Result<ResponseCount, AnalysisError> {
    first_harmonic::response_count(line, question, speeds, parameters)
}

/// Undamped natural frequencies of small vibrations about the stable equilibrium next to zero twist,
/// ascending, rad/s, without the rigid-body motion: what `modes` tells, and nothing besides, for whoever
/// asks often.
///
/// # Errors
/// [`AnalysisError::NoEquilibrium`] where the torques are more than the line carries.
pub fn natural_frequencies(line: &Driveline) -> Result<Vec<f64>, AnalysisError> {
    let modal::vibration::Vibration { equations, state } =
        modal::vibration::Vibration::of(line, None)?;
    modal::elastic::natural_frequencies(&equations, &state.twists)
}

/// Answers a question about a line.
///
/// An analysis that ends early returns what it reached, with the reason in the answer's
/// termination.
///
/// # Errors
/// [`AnalysisError`] where nothing usable could be produced.
pub fn ask(
    line: &Driveline,
    question: &Question,
    observer: &dyn Observer,
) -> Result<Answer, AnalysisError> {
    suits(line, question)?;
    Ok(match question {
        Question::Check => Answer::Check(check::solve(line)?),
        Question::Static => Answer::Static(equilibrium::solve(line, observer)?),
        Question::Modes(question) => Answer::Modes(modal::solve(line, question)?),
        Question::Campbell(question) => Answer::Campbell(campbell::solve(line, question)?),
        Question::Forced(question) => Answer::Forced(forced::solve(line, question, observer)?),
        Question::Simulate(question) => {
            Answer::History(time_response::solve(line, question, observer)?)
        }
        Question::Shock(question) => Answer::History(shock::solve(line, question, observer)?),
        Question::Resonance(question) => match question.method {
            ResonanceMethod::HarmonicBalance => {
                Answer::Resonance(harmonic_balance::solve(line, question, observer)?)
            }
            ResonanceMethod::FirstHarmonic => {
                Answer::Resonance(first_harmonic::solve(line, question, observer)?)
            }
            ResonanceMethod::Averaged => {
                Answer::Resonance(averaging::solve(line, question, observer)?)
            }
        },
        Question::Basins(question) => Answer::Basins(basins::solve(line, question, observer)?),
        Question::Bifurcation(question) => {
            Answer::Bifurcation(bifurcation::solve(line, question, observer)?)
        }
        Question::Folds(question) => match question.method {
            ResonanceMethod::HarmonicBalance => {
                Answer::Folds(harmonic_balance::solve_folds(line, question, observer)?)
            }
            ResonanceMethod::FirstHarmonic => {
                Answer::Folds(first_harmonic::solve_folds(line, question, observer)?)
            }
            ResonanceMethod::Averaged => {
                Answer::Folds(averaging::solve_folds(line, question, observer)?)
            }
        },
    })
}

/// Refuses what a question about motion beyond small vibrations cannot take.
fn suits(line: &Driveline, question: &Question) -> Result<(), AnalysisError> {
    if matches!(
        question,
        Question::Check
            | Question::Static
            | Question::Modes(_)
            | Question::Campbell(_)
            | Question::Forced(_)
    ) {
        return Ok(());
    }
    let equations = EquationsOfMotion::new(line)?;
    if let Some(node) = equations.massless() {
        return Err(AnalysisError::Massless { node: node.to_owned() });
    }
    match equations.linear_damping() {
        Some(what) => Err(AnalysisError::LinearDamping { what, verb: question.verb().name() }),
        None => Ok(()),
    }
}
