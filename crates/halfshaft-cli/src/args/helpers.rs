//! What the helpers take, which ask no question.

use std::path::PathBuf;

use clap::{Args, Subcommand};

use super::common::Common;

/// Helpers for whoever writes model files.
#[derive(Debug, Subcommand)]
pub enum Author {
    /// Write a model file to start from
    #[command(after_help = "Example:
  halfshaft new my-line.toml")]
    New(New),
    /// Print the JSON schema of model or study files, for editors
    #[command(after_help = "Example:
  halfshaft schema --out halfshaft.schema.json     then, at the head of a model file:
  #:schema halfshaft.schema.json")]
    Schema(Schema),
    /// Print shell completions
    #[command(after_help = "Example:
  halfshaft completions bash --out ~/.local/share/bash-completion/completions/halfshaft")]
    Completions(Completions),
    /// Write the manual pages into a folder
    #[command(after_help = "Example:
  halfshaft man ~/.local/share/man/man1")]
    Man(Folder),
    /// Write the reference pages (Markdown) into a folder
    #[command(hide = true)]
    Reference(Folder),
}

#[derive(Args, Debug)]
pub struct New {
    /// File to write [default: line.toml]
    #[arg(value_name = "FILE", default_value = "line.toml", hide_default_value = true)]
    pub file: PathBuf,
    /// Overwrite a file that is there already
    #[arg(long)]
    pub force: bool,
    #[command(flatten)]
    pub quiet: Quiet,
}

#[derive(Args, Debug)]
pub struct Schema {
    /// Of which file [default: model]
    #[arg(
        value_name = "model|study",
        default_value = "model",
        hide_default_value = true,
        value_parser = ["model", "study"],
        hide_possible_values = true
    )]
    pub of: String,
    #[command(flatten)]
    pub printed: Printed,
}

#[derive(Args, Debug)]
pub struct Completions {
    /// Which shell
    pub shell: clap_complete::Shell,
    #[command(flatten)]
    pub printed: Printed,
}

#[derive(Args, Debug)]
pub struct Folder {
    /// Folder to write into; made where it is not there
    #[arg(value_name = "FOLDER")]
    pub folder: PathBuf,
    #[command(flatten)]
    pub quiet: Quiet,
}

#[derive(Args, Debug)]
pub struct Quiet {
    /// Print nothing but errors
    #[arg(long, short)]
    pub quiet: bool,
}

/// Where a text goes that is printed otherwise.
#[derive(Args, Debug)]
pub struct Printed {
    /// Write it into a file instead of printing it
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    #[command(flatten)]
    pub quiet: Quiet,
}

impl Author {
    /// Takes over flags that stand before the command; returns its name and the flags that it has.
    pub fn absorb(&mut self, before: &Common) -> (&'static str, &'static [&'static str]) {
        let (name, quiet, printed) = match self {
            Self::New(new) => ("new", &mut new.quiet, None),
            Self::Man(man) => ("man", &mut man.quiet, None),
            Self::Reference(reference) => ("reference", &mut reference.quiet, None),
            Self::Schema(Schema { printed: Printed { out, quiet }, .. }) => {
                ("schema", quiet, Some(out))
            }
            Self::Completions(Completions { printed: Printed { out, quiet }, .. }) => {
                ("completions", quiet, Some(out))
            }
        };
        quiet.quiet |= before.quiet;
        let Some(out) = printed else { return (name, &["--quiet"]) };
        *out = out.take().or_else(|| before.out.clone());
        (name, &["--quiet", "--out"])
    }
}
