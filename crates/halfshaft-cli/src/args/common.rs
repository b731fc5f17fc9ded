//! Flags that several commands share.

use std::path::PathBuf;

use clap::Args;

const COMMON: &str = "Common flags";

/// Flags of the questions and of the report.
#[derive(Args, Debug, Default)]
pub struct Common {
    /// Change a number of the model: "half-shaft.cubic=-500 N·m/rad³" (repeatable)
    #[arg(long = "set", value_name = "ADDRESS=VALUE", help_heading = COMMON)]
    pub settings: Vec<String>,
    /// Print the result as JSON and nothing else
    #[arg(long, help_heading = COMMON)]
    pub json: bool,
    /// Write the result into a file, in the form of its ending (.json .csv .parquet .svg .png
    /// .html), or in all forms into a folder (a name without ending)
    #[arg(long, value_name = "FILE_OR_FOLDER", help_heading = COMMON)]
    pub out: Option<PathBuf>,
    /// Print nothing but errors
    #[arg(long, short, help_heading = COMMON)]
    pub quiet: bool,
}

impl Common {
    /// Takes over the flags that stand before the command.
    pub fn absorb(&mut self, before: Self) {
        let own = std::mem::replace(&mut self.settings, before.settings);
        self.settings.extend(own);
        self.json |= before.json;
        self.quiet |= before.quiet;
        self.out = self.out.take().or(before.out);
    }

    /// The first flag that is given, other than those named.
    pub fn given_beside(&self, known: &[&str]) -> Option<&'static str> {
        let given = [
            ("--set", !self.settings.is_empty()),
            ("--json", self.json),
            ("--out", self.out.is_some()),
            ("--quiet", self.quiet),
        ];
        given
            .into_iter()
            .find(|(flag, given)| *given && !known.contains(flag))
            .map(|(flag, _)| flag)
    }
}
