//! SVG text.

use halfshaft_present::figure::svg::{SvgOptions, render};
use halfshaft_present::figure::{Axis, Colour, Curve, Figure, Panel, escape};
use roxmltree::{Document, Node};

use super::samples::{HOSTILE, diagonal, one_of_each};

fn elements<'a>(document: &'a Document<'a>, name: &'a str) -> impl Iterator<Item = Node<'a, 'a>> {
    document
        .descendants()
        .filter(move |node| node.has_tag_name(("http://www.w3.org/2000/svg", name)))
}

fn class_of<'a>(node: Node<'a, 'a>) -> &'a str {
    node.parent().and_then(|parent| parent.attribute("class")).unwrap_or("")
}

/// Oracle: an independent XML parser, and the stated size: 6.4 x 4.2 inches at 96 pixels per inch.
#[test]
fn the_file_states_its_size_and_says_what_it_shows() {
    let figure = diagonal().with_caption("A line < a curve");
    let text = render(&figure, &SvgOptions::default());
    let document = Document::parse(&text).unwrap();
    let root = document.root_element();
    let of = |name: &str| root.attribute(name).unwrap();
    assert_eq!((of("viewBox"), of("width"), of("height")), ("0 0 460.8 302.4", "614.4", "403.2"));
    assert_eq!((of("role"), of("id")), ("img", "hs-diagonal"));
    assert_eq!(elements(&document, "desc").next().unwrap().text(), Some("A line < a curve"));
    assert!(text.starts_with("<?xml"));
    assert!(render(&figure, &SvgOptions { embed_in_html: true }).starts_with("<svg"));
}

/// Oracle: geometry. The curve runs from the lower left to the upper right corner of the frame.
#[test]
fn a_diagonal_curve_joins_the_corners_of_its_frame() {
    let text = render(&diagonal(), &SvgOptions::default());
    let document = Document::parse(&text).unwrap();
    let path = |class: &str| {
        let mut paths = elements(&document, "path").filter(|node| class_of(*node) == class);
        paths.next().and_then(|node| node.attribute("d")).unwrap().to_owned()
    };
    let numbers = |data: &str| -> Vec<f64> {
        let data = data.replace(['M', 'z'], "").replace('l', " ").replace('-', " -");
        data.split_whitespace().map(|number| number.parse().unwrap()).collect()
    };
    let (frame, curve) = (numbers(&path("hs-frame")), numbers(&path("hs-curve")));
    let (left, top, width, height) = (frame[0], frame[1], frame[2], frame[5]);
    let expected = [left, top + height, width, -height];
    for (found, expected) in curve.iter().zip(expected) {
        assert!((found - expected).abs() < 0.011, "{curve:?} in {frame:?}");
    }
}

/// Oracle: the parser again: hostile text comes back as text, and no element was made from it.
#[test]
fn hostile_text_stays_text() {
    for options in [SvgOptions::default(), SvgOptions { embed_in_html: true }] {
        let text = render(&one_of_each(&escape(HOSTILE)), &options);
        let document = Document::parse(&text).unwrap();
        assert_eq!(elements(&document, "script").count(), 0);
        let title = elements(&document, "title").next().unwrap();
        assert_eq!(title.text(), Some(HOSTILE));
        let whole = elements(&document, "text").any(|node| node.text() == Some(HOSTILE));
        assert!(whole, "no label holds the text as a whole");
    }
}

/// Oracle: equal input gives equal bytes; all numbers have two decimals at most.
#[test]
fn the_text_is_short_and_always_the_same() {
    let figure = one_of_each("a_1^2");
    let text = render(&figure, &SvgOptions::default());
    assert_eq!(text, render(&figure.clone(), &SvgOptions::default()));
    let decimals = text
        .split(|c: char| !(c.is_ascii_digit() || c == '.'))
        .filter_map(|number| number.split_once('.'))
        .map(|(_, decimals)| decimals.len());
    assert!(decimals.max() <= Some(2));
}

/// Oracle: the words given to the back end, raised and lowered as written.
#[test]
fn scripts_become_shifted_spans() {
    let panel = Panel::new(Axis::new("M_{max}", "s^{-1}"), Axis::default());
    let text = render(&Figure::new("f", "").with(panel), &SvgOptions::default());
    assert!(text.contains("M<tspan dy=\"1.52\" font-size=\"6.65\">max</tspan>"));
    assert!(text.contains("<tspan dy=\"-3.23\" font-size=\"6.65\">-1</tspan>"));
}

/// Oracle: the budget of 20,000 corners a curve at 16 bytes each, whatever the number of points.
#[test]
fn a_million_points_make_a_small_file() {
    let x: Vec<f64> = (0..1_000_000).map(f64::from).collect();
    let y = x.iter().map(|x| (0.7 * x).sin() * (1e-5 * x).cos()).collect();
    let panel =
        Panel::new(Axis::default(), Axis::default()).with(Curve::new("c", x, y, Colour::Blue));
    let text = render(&Figure::new("f", "").with(panel), &SvgOptions::default());
    assert!(text.len() < 320_000, "{} bytes", text.len());
}
