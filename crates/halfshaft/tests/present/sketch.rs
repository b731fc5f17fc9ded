//! The drawing of a line: complete, readable, on its page.

use std::fmt::Write as _;

use halfshaft::model::embedded;
use halfshaft::present::sketch::sketch;
use halfshaft::results::CheckResult;
use halfshaft::{Answer, Driveline, Question, Silent, ask};
use roxmltree::{Document, Node};
use ttf_parser::Face;

use super::common::{line, written};

const REGULAR: &[u8] =
    include_bytes!("../../../halfshaft-present/assets/fonts/DejaVuSans-subset.ttf");
const BOLD: &[u8] =
    include_bytes!("../../../halfshaft-present/assets/fonts/DejaVuSans-Bold-subset.ttf");

/// A rectangle on the page: left, top, right, bottom.
type Frame = [f64; 4];

fn checked(line: &Driveline) -> CheckResult {
    match ask(line, &Question::Check, &Silent) {
        Ok(Answer::Check(check)) => check,
        other => panic!("{other:?}"),
    }
}

/// Engine, gearbox and a long shaft in pieces, with branches and a second output.
fn branched() -> String {
    let mut text = String::from("format = 1\nname = \"Branched\"\n");
    let mut part = |words: std::fmt::Arguments<'_>| text.write_fmt(words).unwrap();
    for body in 0..26 {
        // Sizes over three decades, so that plates differ.
        let inertia = 0.004 * 1.35_f64.powi(body * 7 % 26);
        part(format_args!("[[inertia]]\nname = \"body {body}\"\ninertia = {inertia:.5}\n"));
    }
    for body in 1..26 {
        let from = if body % 5 == 0 { body - 3 } else { body - 1 };
        let cubic = if body % 4 == 1 { "cubic = -900\n" } else { "" };
        part(format_args!(
            "[[shaft]]\nname = \"piece {body} of the line\"\nfrom = \"body {from}\"\n\
             to = \"body {body}\"\nstiffness = {}\ndamping = 1.5\n{cubic}",
            2000 + 917 * body
        ));
    }
    part(format_args!(
        "[[gear]]\nname = \"transfer gear\"\ninput = \"body 4\"\noutput = \"front output\"\n\
         ratio = 2.4\n[[inertia]]\nname = \"front wheels and their tyres\"\ninertia = 1.7\n\
         [[shaft]]\nname = \"front shaft\"\nfrom = \"front output\"\n\
         to = \"front wheels and their tyres\"\nstiffness = 9000\n\
         [[torque]]\nname = \"engine\"\non = \"body 0\"\nmean = 120\namplitude = 25\norder = 2\n\
         [[torque]]\nname = \"load\"\non = \"body 25\"\nmean = \"balance\"\n"
    ));
    text
}

/// Three inertias in a ring of shafts, and one held at ground.
const RING: &str = "format = 1\nname = \"Ring\"\n\
    [[inertia]]\nname = \"a\"\ninertia = 1\n[[inertia]]\nname = \"b\"\ninertia = 2\n\
    [[inertia]]\nname = \"c\"\ninertia = 3\n\
    [[shaft]]\nname = \"ab\"\nfrom = \"a\"\nto = \"b\"\nstiffness = 5\n\
    [[shaft]]\nname = \"bc\"\nfrom = \"b\"\nto = \"c\"\nstiffness = 5\n\
    [[shaft]]\nname = \"ca\"\nfrom = \"c\"\nto = \"a\"\nstiffness = 5\n\
    [[shaft]]\nname = \"wall\"\nfrom = \"c\"\nto = \"ground\"\nstiffness = 5\n";

/// A torque with long words on a node without inertia, beside a shaft whose name takes two lines.
const CROWDED: &str = "format = 1\nname = \"Crowded\"\n\
    [[inertia]]\nname = \"a\"\ninertia = 0.004\n[[inertia]]\nname = \"b\"\ninertia = 3\n\
    [[gear]]\nname = \"g\"\ninput = \"a\"\noutput = \"mid\"\nratio = 2\n\
    [[shaft]]\nname = \"second piece of the line\"\nfrom = \"mid\"\nto = \"b\"\nstiffness = 20\n\
    [[torque]]\nname = \"torque of all engines\"\non = \"mid\"\nmean = 120\namplitude = 25\n\
    [[torque]]\nname = \"brake\"\non = \"a\"\nmean = \"balance\"\n";

fn lines() -> Vec<CheckResult> {
    let example = line(embedded::example(), &[]);
    let scaled = line(embedded::scaled(), &[]);
    let made_up = [written(&branched()), written(RING), written(CROWDED)];
    [example, scaled].iter().chain(&made_up).map(checked).collect()
}

fn number(node: Node<'_, '_>, name: &str) -> f64 {
    node.attribute(name).and_then(|text| text.parse().ok()).unwrap_or_else(|| panic!("no {name}"))
}

fn elements<'a>(drawing: &'a Document<'a>, name: &'a str) -> impl Iterator<Item = Node<'a, 'a>> {
    drawing.descendants().filter(move |node| node.tag_name().name() == name)
}

/// Texts with the frames that their letters fill.
fn texts(drawing: &Document<'_>) -> Vec<(String, Frame)> {
    let faces = [REGULAR, BOLD].map(|font| Face::parse(font, 0).unwrap());
    let framed = |node: Node<'_, '_>| {
        let text: String = node.text().unwrap_or_default().to_owned();
        let face = &faces[usize::from(node.attribute("font-weight") == Some("bold"))];
        let size = number(node, "font-size");
        let advance = |c: char| {
            let glyph = face.glyph_index(c).and_then(|glyph| face.glyph_hor_advance(glyph));
            f64::from(glyph.expect("the font has the letter")) / f64::from(face.units_per_em())
        };
        let half = 0.5 * size * text.chars().map(advance).sum::<f64>();
        assert_eq!(node.attribute("text-anchor"), Some("middle"));
        let (x, y) = (number(node, "x"), number(node, "y"));
        (text, [x - half, y - 0.75 * size, x + half, y + 0.22 * size])
    };
    elements(drawing, "text").map(framed).collect()
}

/// The frame of a path made of one absolute place and relative steps.
fn path_frame(data: &str) -> Vec<(f64, f64)> {
    let mut places = Vec::new();
    for part in data.split('M').filter(|part| !part.trim().is_empty()) {
        let spaced = part.replace('-', " -").replace(['l', 'z'], " ");
        let numbers: Vec<f64> = spaced.split_whitespace().map(|n| n.parse().unwrap()).collect();
        let (mut x, mut y) = (0.0, 0.0);
        for step in numbers.chunks_exact(2) {
            (x, y) = (x + step[0], y + step[1]);
            places.push((x, y));
        }
    }
    places
}

// Source: the model's own list of elements.
#[test]
fn every_part_is_named() {
    for check in lines() {
        let text = sketch(&check);
        let drawing = Document::parse(&text).unwrap();
        // A long name takes two lines, one after the other.
        let told: Vec<String> = texts(&drawing).into_iter().map(|(text, _)| text).collect();
        let told = format!(" {} ", told.join(" "));
        let members = check.reduced_inertias.iter().flat_map(|group| &group.members);
        let names = members
            .map(|member| &member.node)
            .chain(check.gears.iter().map(|gear| &gear.name))
            .chain(check.shafts.iter().map(|shaft| &shaft.name))
            .chain(check.torques.iter().map(|torque| &torque.name));
        for name in names {
            assert!(told.contains(&format!(" {name} ")), "{name} is missing in {told}");
        }
    }
}

// Source: the widths of letters in the font itself.
#[test]
fn texts_do_not_overlap() {
    for check in lines() {
        let text = sketch(&check);
        let drawing = Document::parse(&text).unwrap();
        let texts = texts(&drawing);
        for (index, (one, a)) in texts.iter().enumerate() {
            for (other, b) in &texts[..index] {
                let apart = a[0] >= b[2] || b[0] >= a[2] || a[1] >= b[3] || b[1] >= a[3];
                assert!(apart, "{}: {one} {a:?} lies on {other} {b:?}", check.header.model.name);
            }
        }
    }
}

// Source: geometry: what lies outside of the view box is not seen.
#[test]
fn everything_lies_on_the_page() {
    for check in lines() {
        let text = sketch(&check);
        let drawing = Document::parse(&text).unwrap();
        let view = drawing.root_element().attribute("viewBox").unwrap().to_owned();
        let view: Vec<f64> = view.split(' ').map(|number| number.parse().unwrap()).collect();
        let (width, height) = (view[2], view[3]);
        // Coordinates are rounded to hundredths, relative ones one after the other.
        let inside = |x: f64, y: f64| {
            (-0.05..=width + 0.05).contains(&x) && (-0.05..=height + 0.05).contains(&y)
        };
        let name = &check.header.model.name;
        for (text, frame) in texts(&drawing) {
            let within = inside(frame[0], frame[1]) && inside(frame[2], frame[3]);
            assert!(within, "{name}: {text} at {frame:?} of {width} x {height}");
        }
        for circle in elements(&drawing, "circle") {
            let [x, y, r] = ["cx", "cy", "r"].map(|key| number(circle, key));
            assert!(inside(x - r, y - r) && inside(x + r, y + r), "{name}: circle at {x} {y}");
        }
        for path in elements(&drawing, "path") {
            for (x, y) in path_frame(path.attribute("d").unwrap()) {
                assert!(inside(x, y), "{name}: a corner at {x} {y} of {width} x {height}");
            }
        }
    }
}
