//! Plain values that halfshaft's analyses answer with, and their files.
//!
//! Nothing here computes. An [`Answer`] is one of the results below; every result begins
//! with a [`Header`] (which analysis, of which model, with which settings, how it ended),
//! can be written, read back, and compares equal to itself then.
//!
//! - [`Table`]: named columns with units; the shape of everything that can be plotted.
//! - [`CheckResult`], [`StaticResult`], [`ModesResult`], [`HistoryResult`] (simulate and
//!   shock), [`ResonanceResult`], [`FoldsResult`], [`BasinsResult`], [`BifurcationResult`],
//!   [`StudyResult`], [`ReportResult`].
//! - [`io`]: JSON and CSV files, written under a temporary name and renamed.
//!
//! JSON has no NaN and no infinity. Both are written as `null`, and `null` comes back as NaN where
//! a number must stand and as `None` where none need.

mod answer;
mod basins;
mod bifurcation;
mod campbell;
mod check;
mod equilibrium;
mod folds;
mod forced;
mod header;
mod history;
pub mod io;
mod modes;
mod named;
mod number;
mod report;
mod resonance;
mod special;
mod study;
mod table;

pub use answer::Answer;
pub use basins::{Attractor, BasinGrid, BasinsResult, ShockSearch, SmallestShock};
pub use bifurcation::{BifurcationResult, StrobedBranch, SweepJump};
pub use campbell::{CampbellGear, CampbellResult, CriticalSpeed};
pub use check::{
    CheckResult, CheckedBar, CheckedGear, CheckedGrowth, CheckedHarmonic, CheckedMesh,
    CheckedPulse, CheckedShaft, CheckedTorque, MassElasticSheet, Member, NonlinearTerm,
    ReducedInertia, SheetConnection, SheetInertia,
};
pub use equilibrium::{
    Equilibrium, GearState, Limit, Running, RunningKind, ShaftCapacity, SharedLoad, StaticResult,
};
pub use folds::{FoldsResult, ResponseCount};
pub use forced::{EngineOrders, ForcedGear, ForcedHeat, ForcedPeak, ForcedResult};
pub use header::{Header, ModelIdentity, Reason, Termination};
pub use history::{
    ChannelMetrics, ConnectionEvents, EnergyBalance, HistoryEvent, HistoryMetrics, HistoryResult,
    IntegratorUse, MethodRow, NodeMetrics, OrderMap, ShaftMetrics, ShockDetails,
};
pub use modes::{Gear, Mode, ModesInGear, ModesResult};
pub use named::{Named, Names};
pub use report::{LevelRow, MissingSection, ReportResult};
pub use resonance::{Branch, Effort, JumpSpeeds, ModeScaling, ResonanceResult, VerifiedPoint};
pub use special::{SpecialKind, SpecialPoint, Status};
pub use study::{ComparisonRow, ItemStyle, StudyFigureSpec, StudyItem, StudyResult};
pub use table::{Column, Table, column_names};
