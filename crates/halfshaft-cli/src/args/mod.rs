//! What the command line takes.

mod common;
mod helpers;
mod linear;
mod periodic;
mod questions;
mod words;

use std::path::PathBuf;

use clap::builder::styling::{AnsiColor, Styles};
use clap::{Args, Parser, Subcommand};

pub use common::Common;
pub use helpers::{Author, Folder, New, Printed};
pub use questions::{Ask, Model};

const STYLES: Styles = Styles::styled()
    .header(AnsiColor::Green.on_default().bold())
    .usage(AnsiColor::Green.on_default().bold())
    .literal(AnsiColor::Cyan.on_default().bold())
    .placeholder(AnsiColor::Cyan.on_default());

/// Nonlinear torsional dynamics of automotive drivelines.
///
/// Give it a driveline in one readable file and ask: how far does it wind up, how much torque can
/// it carry, where does it resonate, how does it take a shock, when does its response jump?
#[derive(Debug, Parser)]
#[command(
    name = "halfshaft",
    version,
    styles = STYLES,
    max_term_width = 100,
    after_help = "Examples:
  halfshaft report                        everything about the built-in example, in report.html
  halfshaft new my-line.toml              a model file to start from
  halfshaft check my-line.toml            is it sound?
  halfshaft static my-line.toml           how far does it wind up, how much can it carry?
  halfshaft resonance my-line.toml --verify --out response.svg

Without MODEL, the built-in two-mass driveline with a softening half-shaft is used.
An address is <element name>.<key>: half-shaft.cubic, engine.inertia, road load.pulse.peak.
Values carry units (\"6420 N·m/rad\", \"2500 rpm\", \"20 ms\"); bare numbers are in SI.
Exit status: 0 done, 1 the analysis could not be carried out, 2 bad input or usage."
)]
pub struct Arguments {
    /// Flags before the command, which mean the same as behind it.
    #[command(flatten)]
    pub before: Common,
    #[command(subcommand)]
    pub command: Command,
}

/// What can be done.
#[derive(Debug, Subcommand)]
#[expect(clippy::large_enum_variant, reason = "one is made a run, and boxes would hide the flags")]
pub enum Command {
    #[command(flatten)]
    Ask(Ask),
    /// Everything about a driveline in one self-contained HTML page
    ///
    /// Summary in plain words first, then static, modes, shock, resonance and fold curves with
    /// figures to zoom and read off; closed form, first harmonic, harmonic balance and integration
    /// stand side by side with their differences in numbers. Without --out it is report.html.
    #[command(after_help = "Examples:
  halfshaft report                               the built-in example, in report.html
  halfshaft report my-line.toml --out line.html
  halfshaft report --set \"half-shaft.cubic=642\"")]
    Report(Report),
    /// Ask a list of questions from a study file
    ///
    /// A study names a model, asks questions of it, draws figures from the answers and compares
    /// numbers with printed ones. With --out FOLDER it writes a page, the figures and the
    /// comparison. docs/study-file.md lists the keys, `halfshaft schema study` has them for editors.
    #[command(after_help = "Example:
  halfshaft run examples/two-mass-driveline/paper.toml --out paper/")]
    Run(Run),
    #[command(flatten)]
    Author(Author),
}

#[derive(Args, Debug)]
pub struct Report {
    #[command(flatten)]
    pub model: Model,
}

// That a study brings its own settings is said where one is given.
#[derive(Args, Debug)]
#[command(mut_arg("settings", |settings| settings.hide(true)))]
pub struct Run {
    /// Study file (TOML)
    #[arg(value_name = "STUDY")]
    pub study: PathBuf,
    #[command(flatten)]
    pub common: Common,
}

impl Command {
    /// Whether nothing but errors may be printed.
    pub fn is_quiet(&self) -> bool {
        match self {
            Self::Ask(ask) => ask.question().1.common.quiet,
            Self::Report(report) => report.model.common.quiet,
            Self::Run(run) => run.common.quiet,
            // Helpers show no progress.
            Self::Author(_) => true,
        }
    }
}

impl Arguments {
    /// The command, with the flags that stand before it.
    ///
    /// # Errors
    /// A usage error where a flag stands before a command that does not take it.
    pub fn complete(self) -> Result<Command, clap::Error> {
        let Self { before, mut command } = self;
        let (name, taken): (&str, &[&str]) = match &mut command {
            Command::Ask(ask) => {
                ask.model_mut().common.absorb(before);
                return Ok(command);
            }
            Command::Report(report) => {
                report.model.common.absorb(before);
                return Ok(command);
            }
            Command::Run(run) => {
                run.common.absorb(before);
                return Ok(command);
            }
            Command::Author(author) => author.absorb(&before),
        };
        match before.given_beside(taken) {
            None => Ok(command),
            Some(flag) => {
                let message = format!("`halfshaft {name}` has no {flag}");
                Err(<Self as clap::CommandFactory>::command()
                    .error(clap::error::ErrorKind::ArgumentConflict, message))
            }
        }
    }
}
