//! Why a question could not be answered at all.

use halfshaft_dynamics::DynamicsError;
use halfshaft_model::ChangeError;

/// Why nothing usable could be produced. An analysis that ends early with something to show
/// returns it with a termination reason instead.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum AnalysisError {
    /// The line has no equations of motion.
    #[error(transparent)]
    Dynamics(#[from] DynamicsError),
    /// The line cannot be had with the values that a sweep asks for.
    #[error(transparent)]
    Change(#[from] ChangeError),
    /// The mathematics failed.
    #[error("while {doing}: {source}")]
    Numerics {
        /// What was being done.
        doing: &'static str,
        /// What failed.
        source: halfshaft_numerics::Error,
    },
    /// An integration that a closed form starts from did not come to its end.
    #[error("the integration ended while {doing}: {reached}")]
    EndedEarly {
        /// What was being done.
        doing: &'static str,
        /// How far it came, and why no farther.
        reached: String,
    },
    /// The state about which the question is asked does not exist.
    #[error("there is no stable state under the mean torques: {reason}")]
    NoEquilibrium {
        /// Why, with numbers.
        reason: String,
    },
    /// The equilibrium that was asked for is not among those found.
    #[error("there is no equilibrium number {asked}: the line has {found}")]
    NoSuchEquilibrium {
        /// Number asked for, from 1.
        asked: usize,
        /// How many there are.
        found: usize,
    },
    /// The line has fewer elastic modes.
    #[error("there is no elastic mode number {asked}: the line has {found}")]
    NoSuchMode {
        /// Number asked for, from 1.
        asked: usize,
        /// How many there are.
        found: usize,
    },
    /// A method that does not fit this line.
    #[error("the method {method} does not fit this line: {reason}")]
    MethodDoesNotFit {
        /// Name of the method.
        method: &'static str,
        /// Why.
        reason: String,
    },
    /// A node without inertia in a question about motion.
    #[error("\"{node}\" has no inertia, so nothing says how it accelerates")]
    Massless {
        /// The node.
        node: String,
    },
    /// Damping that only linear vibrations know.
    #[error("{what} is damping of linear vibrations: `{verb}` cannot take it")]
    LinearDamping {
        /// The damping.
        what: String,
        /// What was asked.
        verb: &'static str,
    },
    /// An answer that would not fit.
    #[error("the answer would have {values} numbers, and at most {most} are told")]
    TooLarge {
        /// Numbers of the answer.
        values: usize,
        /// Numbers that are told.
        most: usize,
        /// What to leave out.
        advice: &'static str,
    },
    /// A shock without anything that disturbs.
    #[error("nothing disturbs the line")]
    NoDisturbance,
    /// A resonance without anything that excites.
    #[error("nothing excites the line: {reason}")]
    NoExcitation {
        /// Why.
        reason: String,
    },
    /// Initial values that no state has.
    #[error("no state has these initial values: {reason}")]
    InitialValues {
        /// Why.
        reason: String,
    },
    /// A mode that the averaged equations cannot describe.
    #[error("mode {mode} cannot be averaged: {reason}")]
    NotAveraged {
        /// Which elastic mode, from 1.
        mode: usize,
        /// Why.
        reason: String,
    },
}

impl AnalysisError {
    /// What to try.
    pub fn advice(&self) -> Option<String> {
        let text = match self {
            Self::NoEquilibrium { .. } => {
                "lower the mean torques, take another gear or raise the shaft's stiffness; \
                 `halfshaft static` shows the capacity of each shaft"
            }
            Self::NoSuchEquilibrium { .. } => "`halfshaft static` lists the equilibria",
            Self::NoSuchMode { .. } => "`halfshaft modes` lists the modes",
            Self::MethodDoesNotFit { method: "averaged", .. } => {
                "--method harmonic-balance takes any law"
            }
            Self::MethodDoesNotFit { method: "first-harmonic", .. } => {
                "--method harmonic-balance takes any law and any number of nonlinear shafts"
            }
            Self::MethodDoesNotFit { method: "harmonic-balance" | "bifurcation", .. } => {
                "`halfshaft simulate` takes any line, one speed at a time"
            }
            Self::MethodDoesNotFit { .. } => "--method full takes any line",
            Self::Massless { .. } => {
                "give the node an [[inertia]], or join the shafts at it to one; `static`, `modes`, \
                 `campbell` and `forced` take nodes without inertia"
            }
            Self::LinearDamping { .. } => {
                "give the shafts a damping instead and leave it out, e.g. --set line.modal_damping=0 \
                 --set line.loss_factor=0; `modes` tells the damping ratios that result"
            }
            Self::TooLarge { advice, .. } => advice,
            Self::NoDisturbance => {
                "give a torque of the model a pulse, or ask `halfshaft shock` with \
                 --initial \"SHAFT.twist=1 rad\", SHAFT being a shaft of the model"
            }
            Self::NoExcitation { .. } => {
                "give a torque of the model an amplitude (and order) at a node that the mode moves"
            }
            Self::Numerics { .. }
            | Self::EndedEarly { .. }
            | Self::Dynamics(_)
            | Self::Change(_)
            | Self::InitialValues { .. }
            | Self::NotAveraged { .. } => return None,
        };
        Some(text.to_owned())
    }
}

/// Says what was being done when the mathematics failed.
pub(crate) trait Doing<T> {
    fn doing(self, what: &'static str) -> Result<T, AnalysisError>;
}

impl<T> Doing<T> for Result<T, halfshaft_numerics::Error> {
    fn doing(self, what: &'static str) -> Result<T, AnalysisError> {
        self.map_err(|source| AnalysisError::Numerics { doing: what, source })
    }
}
