//! The questions about linear vibrations with their options, as text.

use clap::Args;
use halfshaft::QuestionText;

use super::questions::Model;

#[derive(Args, Debug)]
pub struct Campbell {
    #[command(flatten)]
    pub model: Model,
    /// Range of the excitation speed Ω, e.g. 0rpm..7000rpm [default: beyond the operating range, or
    /// beyond the lowest critical speeds]
    #[arg(long, value_name = "A..B", allow_hyphen_values = true)]
    pub frequency: Option<String>,
    /// Orders, e.g. 0.5,1,2 [default: those of the model's torques]
    #[arg(long, value_name = "N,N,...", allow_hyphen_values = true)]
    pub orders: Option<String>,
    /// Operating range of Ω that critical speeds should keep away from [default: `operating` of the
    /// model]
    #[arg(long, value_name = "A..B", allow_hyphen_values = true)]
    pub operating: Option<String>,
    /// How many of the lowest elastic modes [default: 12]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub count: Option<String>,
    /// Only in the gear that the model is in, not in all that a gearbox lists
    #[arg(long)]
    pub this_gear: bool,
}

#[derive(Args, Debug)]
pub struct Forced {
    #[command(flatten)]
    pub model: Model,
    /// Range of the excitation speed Ω, e.g. 800rpm..6000rpm [default: the operating range of the
    /// model and a quarter to either side, or beyond the lowest resonances]
    #[arg(long, value_name = "A..B", allow_hyphen_values = true)]
    pub frequency: Option<String>,
    /// Number of speeds, equally spaced [default: 400, and more about the resonances]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub points: Option<String>,
    /// Orders that act, e.g. 0.5,1,2 [default: all of the model's torques]
    #[arg(long, value_name = "N,N,...", allow_hyphen_values = true)]
    pub orders: Option<String>,
    /// Shafts to tell of, order by order too [default: all; with their orders up to 400 of them together]
    #[arg(long, value_name = "NAME,NAME,...")]
    pub shaft: Option<String>,
    /// Nodes to tell of, order by order too [default: all of a line of up to 16 inertias]
    #[arg(long, value_name = "NAME,NAME,...")]
    pub node: Option<String>,
    /// Only in the gear that the model is in, not in all that a gearbox lists
    #[arg(long)]
    pub this_gear: bool,
}

impl Campbell {
    pub(super) fn text(&self) -> QuestionText {
        QuestionText {
            frequency: self.frequency.clone(),
            orders: self.orders.clone(),
            operating: self.operating.clone(),
            count: self.count.clone(),
            this_gear: self.this_gear,
            ..QuestionText::default()
        }
    }
}

impl Forced {
    pub(super) fn text(&self) -> QuestionText {
        QuestionText {
            frequency: self.frequency.clone(),
            points: self.points.clone(),
            orders: self.orders.clone(),
            shaft: self.shaft.clone(),
            node: self.node.clone(),
            this_gear: self.this_gear,
            ..QuestionText::default()
        }
    }
}
