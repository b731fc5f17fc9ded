//! Names that would act on a page or a terminal if they were let.

use halfshaft::Answer;
use halfshaft::present::{figures, sketch, summary};
use halfshaft::results::io;
use roxmltree::{Document, Node};

use super::common::{EMBEDDED, flat, renamed, the_report};
use super::html::{Page, text_of};

/// Ends a script, an element, an attribute, a comment and a section of character data.
const MARKUP: &str = "a</script><script>alert(1)</script><evil b='\"' onclick=\"c()\">&lt; ]]> -->";

/// Colours, clears, rings, turns the reading direction, breaks the line; C1 controls as well.
const TERMINAL: &str =
    "a\u{1b}[31m\u{1b}]0;t\u{7}b\u{9b}2J\u{202e}c\r\nd\u{2028}e\u{85}f\u{8}\u{7f}";

/// The embedded example's report about parts of that name.
fn named(name: &str) -> Answer {
    let own = the_report(&EMBEDDED);
    let names = [
        (own.header.model.name.as_str(), name),
        (own.check.description.as_str(), name),
        ("half-shaft", name),
        ("engine torque", name),
        ("vehicle", name),
        ("gearbox", name),
    ];
    renamed(&EMBEDDED, &names)
}

/// The parts of a report as answers of their own.
fn parts(answer: &Answer) -> Vec<Answer> {
    let report = the_report(answer);
    let mut parts = vec![answer.clone(), Answer::Check(report.check.clone())];
    parts.extend(report.statics.clone().map(Answer::Static));
    parts.extend(report.modes.clone().map(Answer::Modes));
    parts.extend(report.shock.clone().map(Answer::History));
    let resonances = [&report.resonance, &report.first_harmonic, &report.closed_form];
    parts.extend(resonances.into_iter().flatten().cloned().map(Answer::Resonance));
    let planes = report.folds.iter().chain(&report.closed_folds);
    parts.extend(planes.cloned().map(Answer::Folds));
    parts
}

// Source: an XML parser: the name comes back letter by letter, and no element or attribute came of
// it.
#[test]
fn markup_in_names_stays_text() {
    for answer in parts(&named(MARKUP)) {
        let page = Page::of(&answer);
        let document = page.document();
        assert!(!document.descendants().any(|node| node.tag_name().name() == "evil"));
        let attributes = document.descendants().flat_map(|node| node.attributes());
        assert!(attributes.map(|a| a.name()).all(|name| !name.starts_with("on")));
        let of = |name: &str| -> Vec<String> {
            let found = document.descendants().filter(|node| node.tag_name().name() == name);
            found.map(text_of).collect()
        };
        assert_eq!(of("h1"), [MARKUP]);
        assert!(of("title")[0].starts_with(MARKUP));
        if matches!(answer, Answer::Report(_)) {
            assert!(of("td").iter().any(|cell| cell == MARKUP), "the half-shaft's row");
            assert!(of("p").iter().any(|lead| lead == MARKUP), "the description");
        }
        let json: Vec<&String> =
            page.raw.iter().filter(|(tag, _)| tag.contains("json")).map(|(_, text)| text).collect();
        // Without a "<" a script element cannot end, nor begin a comment.
        assert!(json.iter().all(|text| !text.contains('<')));
        let own = json.last().expect("the answer comes last");
        assert_eq!(io::from_json(own).unwrap(), answer);
    }
}

// Source: an XML parser, on the files that are written beside the page.
#[test]
fn markup_in_names_stays_text_in_drawings() {
    let answer = named(MARKUP);
    let mut drawings: Vec<String> = figures::of(&answer)
        .iter()
        .map(|figure| halfshaft::present::figure::svg::render(figure, &Default::default()))
        .collect();
    drawings.push(sketch::sketch(&the_report(&answer).check));
    for drawing in drawings {
        let document = Document::parse(&drawing).unwrap();
        let is_evil = |node: &Node<'_, '_>| matches!(node.tag_name().name(), "evil" | "script");
        assert!(!document.descendants().any(|node| is_evil(&node)));
    }
}

// Source: ECMA-48 and Unicode: a terminal acts on control characters (category Cc) only; U+202A to
// U+202E and U+2066 to U+2069 turn the reading direction, U+2028 and U+2029 break lines.
#[test]
fn names_cannot_act_on_a_terminal() {
    for answer in parts(&named(TERMINAL)) {
        let text = summary::text(&answer);
        let acts = |c: char| {
            (c.is_control() && c != '\n')
                || ('\u{2028}'..='\u{202e}').contains(&c)
                || ('\u{2066}'..='\u{2069}').contains(&c)
        };
        let found: Vec<&str> = text.lines().filter(|line| line.contains(acts)).collect();
        assert!(found.is_empty(), "{found:?}");
        // The letters are still there.
        assert!(flat(&text).contains("[31m"));
    }
}
