//! The page: well formed, closed to the network, complete.

use halfshaft::model::embedded;
use halfshaft::present::{figures, html};
use halfshaft::results::io;
use halfshaft::{Answer, Silent, ask};
use roxmltree::{Document, Node};

use super::common::{EMBEDDED, OVERLOADED, SCALED, answers, line, study, the_report, written};

/// A page cut for an XML parser: what only HTML allows is rewritten, and the contents of scripts
/// and styles, which HTML takes letter by letter, are set aside.
pub struct Page {
    pub xml: String,
    /// Opening tag and content.
    pub raw: Vec<(String, String)>,
}

impl Page {
    pub fn of(answer: &Answer) -> Self {
        let page = html::page(answer);
        let mut rest = page.strip_prefix("<!DOCTYPE html>").expect("a page says what it is");
        let (mut xml, mut raw) = (String::new(), Vec::new());
        let next = |rest: &str| {
            ["<script", "<style"].map(|tag| rest.find(tag)).into_iter().flatten().min()
        };
        while let Some(at) = next(rest) {
            let open = at + rest[at..].find('>').unwrap() + 1;
            let end = if rest[at..].starts_with("<style") { "</style" } else { "</script" };
            // HTML ends a script at the first such letters, in capitals or not.
            let length = rest[open..].to_ascii_lowercase().find(end).unwrap();
            xml.push_str(&rest[..open]);
            raw.push((rest[at..open].to_owned(), rest[open..open + length].to_owned()));
            rest = &rest[open + length..];
        }
        xml.push_str(rest);
        Self { xml: closed_metas(&xml).replace(" hidden data-", " hidden=\"\" data-"), raw }
    }

    pub fn document(&self) -> Document<'_> {
        Document::parse(&self.xml).unwrap_or_else(|mistake| panic!("{mistake}:\n{}", self.xml))
    }

    fn script(&self, mark: &str) -> &str {
        let found = self.raw.iter().find(|(tag, _)| tag.contains(mark));
        &found.expect("the script is there").1
    }
}

fn closed_metas(xml: &str) -> String {
    let mut parts = xml.split("<meta");
    let mut closed = parts.next().unwrap().to_owned();
    for part in parts {
        closed += &format!("<meta{}", part.replacen('>', "/>", 1));
    }
    closed
}

/// All text within an element, unbreakable spaces as usual ones.
pub fn text_of(node: Node<'_, '_>) -> String {
    let text: String = node.descendants().filter(Node::is_text).filter_map(|n| n.text()).collect();
    text.replace('\u{a0}', " ")
}

fn named<'a>(document: &'a Document<'a>, name: &'a str) -> impl Iterator<Item = Node<'a, 'a>> {
    document.descendants().filter(move |node| node.tag_name().name() == name)
}

/// Looks at what must hold of any page: ids, links, contents.
pub fn assert_sound(page: &Page) {
    let document = page.document();
    let mut ids: Vec<&str> = document.descendants().filter_map(|n| n.attribute("id")).collect();
    let count = ids.len();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), count, "an id twice in {ids:?}");
    assert!(ids.iter().all(|id| !id.is_empty() && !id.contains(char::is_whitespace)));
    let links = document.descendants().filter_map(|node| node.attribute("href"));
    let described = document.descendants().filter_map(|n| n.attribute("aria-describedby"));
    for target in links.map(|link| link.trim_start_matches('#')).chain(described) {
        assert!(ids.binary_search(&target).is_ok(), "nothing is called {target}");
    }
    // Every section of the page stands in its contents, in the same order.
    let sections: Vec<String> = named(&document, "section")
        .filter_map(|section| Some(format!("#{}", section.attribute("id")?)))
        .collect();
    let contents = named(&document, "nav").flat_map(|nav| nav.descendants());
    let listed: Vec<&str> = contents.filter_map(|node| node.attribute("href")).collect();
    assert_eq!(listed, sections);
}

/// Pages of all kinds.
fn pages() -> Vec<Page> {
    let mut pages: Vec<Page> = [&*EMBEDDED, &*OVERLOADED, &*SCALED].map(Page::of).into();
    pages.push(Page::of(&study()));
    pages.extend(answers(&line(embedded::example(), &[])).iter().map(Page::of));
    pages
}

// Source: an XML parser, and the Content Security Policy Level 3: without a source that names a
// host or a scheme of the network, nothing is fetched.
#[test]
fn pages_are_well_formed_and_ask_nothing_of_the_network() {
    for page in pages() {
        let document = page.document();
        let policy = named(&document, "meta")
            .find(|meta| meta.attribute("http-equiv") == Some("Content-Security-Policy"))
            .and_then(|meta| meta.attribute("content"))
            .expect("a policy");
        assert!(policy.split(';').any(|rule| rule.trim() == "default-src 'none'"));
        for rule in policy.split(';') {
            for source in rule.split_whitespace().skip(1) {
                assert!(["'none'", "'unsafe-inline'", "data:"].contains(&source), "{policy}");
            }
        }
        for attribute in document.descendants().flat_map(|node| node.attributes()) {
            let (name, value) = (attribute.name(), attribute.value());
            let leads = ["src", "href", "srcset", "action", "formaction", "poster", "data"];
            assert!(!leads.contains(&name) || value.starts_with('#'), "{name}=\"{value}\"");
            assert!(!name.starts_with("on"), "{name}=\"{value}\"");
            assert!(!value.contains("url("), "{name}=\"{value}\"");
        }
        let styles = page.raw.iter().filter(|(tag, _)| tag.starts_with("<style"));
        for (_, style) in styles {
            assert!(!style.contains("url(") && !style.contains("@import"));
        }
        for absent in ["link", "iframe", "object", "embed", "base", "img", "form"] {
            assert_eq!(named(&document, absent).count(), 0, "{absent}");
        }
    }
}

// Source: HTML: an id names one element and holds no space; a link within the page needs its
// target.
#[test]
fn ids_are_unique_and_links_lead_somewhere() {
    let two = "format = 1\nname = \"Two shafts\"\n[[inertia]]\nname = \"a\"\ninertia = 1\n\
        [[shaft]]\nname = \"Welle ä\"\nfrom = \"a\"\nto = \"ground\"\nstiffness = 9\ncubic = -1\n\
        [[shaft]]\nname = \"Welle ö\"\nfrom = \"a\"\nto = \"ground\"\nstiffness = 9\ncubic = -1\n\
        [[shaft]]\nname = \"s.1\"\nfrom = \"a\"\nto = \"ground\"\nstiffness = 9\ncubic = -1\n\
        [[shaft]]\nname = \"s_1\"\nfrom = \"a\"\nto = \"ground\"\nstiffness = 9\ncubic = -1\n";
    let alike = ask(&written(two), &halfshaft::Question::Static, &Silent).unwrap();
    let mut all = pages();
    all.push(Page::of(&alike));
    for page in all {
        assert_sound(&page);
    }
}

// Source: the answer itself, read back by the reader of results.
#[test]
fn the_numbers_travel_with_the_page() {
    let mut all = answers(&line(embedded::example(), &[]));
    all.extend([EMBEDDED.clone(), SCALED.clone(), study()]);
    for answer in all {
        let page = Page::of(&answer);
        assert_eq!(io::from_json(page.script("id=\"answer\"")).unwrap(), answer);
    }
}

// Source: the list of the answer's figures.
#[test]
fn every_figure_stands_in_the_page_once() {
    let mut all = answers(&line(embedded::example(), &[]));
    all.extend([EMBEDDED.clone(), SCALED.clone(), OVERLOADED.clone(), study()]);
    for answer in all {
        let page = Page::of(&answer);
        let document = page.document();
        let plots = named(&document, "figure").filter(|f| f.attribute("class") == Some("plot"));
        let mut shown: Vec<&str> = plots.filter_map(|figure| figure.attribute("id")).collect();
        let figures = figures::of(&answer);
        let mut wanted: Vec<String> = figures.iter().map(|f| format!("fig-{}", f.id)).collect();
        shown.sort_unstable();
        wanted.sort_unstable();
        assert_eq!(shown, wanted);
        // Each holds its drawing and the data of the live graph.
        assert_eq!(
            named(&document, "svg").filter(|svg| svg.has_attribute("viewBox")).count(),
            wanted.len()
                + named(&document, "figure")
                    .filter(|f| f.attribute("class") == Some("sketch"))
                    .count()
        );
        let data = page.raw.iter().filter(|(tag, _)| *tag == "<script type=\"application/json\">");
        let graphs: Vec<serde_json::Value> =
            data.map(|(_, text)| serde_json::from_str(text).unwrap()).collect();
        assert_eq!(graphs.len(), wanted.len());
        assert!(graphs.iter().all(|graph| graph["data"].is_array()));
    }
}

// Source: the study's own list: a figure stands in its section, whatever its name is as an id.
#[test]
fn every_figure_of_a_study_stands_in_its_section() {
    let study = study();
    let page = Page::of(&study);
    let document = page.document();
    for (number, figure) in figures::of(&study).iter().enumerate() {
        let own = named(&document, "figure")
            .find(|found| found.attribute("id") == Some(&format!("fig-{}", figure.id)))
            .expect("the figure is there");
        let section = own.ancestors().find(|node| node.tag_name().name() == "section");
        let id = section.and_then(|section| section.attribute("id"));
        assert_eq!(id, Some(format!("figure-{}", number + 1).as_str()), "{}", figure.id);
    }
}

// Source: statics by hand: a gear fails where 850 N·m times its ratio times 5.71 is more than the
// largest torque of the law.
#[test]
fn a_report_begins_with_what_does_not_hold() {
    let fails =
        |ratio: &f64| super::common::by_hand::DEMAND * ratio > super::common::by_hand::capacity();
    let ratios = [5.82, 3.23, 1.79, 1.0, 0.64];
    for answer in [&*EMBEDDED, &*OVERLOADED] {
        let page = Page::of(answer);
        let document = page.document();
        let first = named(&document, "section").next().expect("a section");
        assert_eq!(first.attribute("id"), Some("summary"));
        let headline = first.descendants().find(|n| n.attribute("class") == Some("headline"));
        let headline = text_of(headline.expect("a headline"));
        let unsafe_part = headline.split("Safe:").next().unwrap().to_owned();
        assert!(unsafe_part.starts_with("Not safe:"), "{headline}");
        for ratio in ratios {
            let words: Vec<&str> = unsafe_part.split([' ', ',', ':']).collect();
            let told = words.iter().any(|w| w.trim_end_matches('.') == ratio.to_string());
            assert_eq!(told, fails(&ratio), "gear {ratio}: {headline}");
        }
        let gears = &the_report(answer).statics.as_ref().unwrap().gears;
        assert!(gears.iter().all(|gear| gear.exists != fails(&gear.ratio)));
    }
}
