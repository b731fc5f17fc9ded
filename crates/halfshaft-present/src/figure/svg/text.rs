//! Lines of text.

use std::fmt::Write;

use super::hex;
use super::number::Hundredths;
use crate::figure::scene::{Align, Level, Text, Weight};
use crate::figure::typeset::xml_escape;

/// Appends a text element.
pub(super) fn write_text(out: &mut String, text: &Text) {
    let (x, y) = (Hundredths::of(text.place.x), Hundredths::of(text.place.y));
    let size = Hundredths::of(text.size);
    let colour = hex(text.colour);
    let _ = write!(out, "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" fill=\"{colour}\"");
    match text.align {
        Align::Start => {}
        Align::Middle => out.push_str(" text-anchor=\"middle\""),
        Align::End => out.push_str(" text-anchor=\"end\""),
    }
    if text.weight == Weight::Bold {
        out.push_str(" font-weight=\"bold\"");
    }
    if text.upright {
        let _ = write!(out, " transform=\"rotate(-90 {x} {y})\"");
    }
    if text.halo {
        out.push_str(" stroke=\"#ffffff\" stroke-width=\"2\" stroke-linejoin=\"round\" paint-order=\"stroke\"");
    }
    out.push('>');
    write_runs(out, text);
    out.push_str("</text>\n");
}

/// Steps with `dy`, because viewers disagree on `baseline-shift`.
fn write_runs(out: &mut String, text: &Text) {
    let mut risen = 0.0;
    for run in &text.rich.runs {
        let rise = run.level.rise(text.size);
        let step = risen - rise;
        let words = xml_escape(&run.text);
        if run.level == Level::Base && step == 0.0 {
            out.push_str(&words);
        } else {
            let (down, size) = (Hundredths::of(step), Hundredths::of(run.level.size(text.size)));
            let _ = write!(out, "<tspan dy=\"{down}\" font-size=\"{size}\">{words}</tspan>");
        }
        risen = rise;
    }
}
