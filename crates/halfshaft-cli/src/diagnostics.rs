//! How mistakes in files look: the line, the offending text underlined, a hint.

use std::io::IsTerminal;

use annotate_snippets::{AnnotationKind, Group, Level, Renderer, Snippet};
use halfshaft::Diagnostics;
use halfshaft::model::{Diagnostic, Severity, Source};

/// Findings as text for standard error, with colours where that is a terminal; of many the first
/// ones.
pub fn render(found: &Diagnostics) -> String {
    let coloured = std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    let renderer = if coloured { Renderer::styled() } else { Renderer::plain() };
    let mut paragraphs: Vec<String> = Vec::new();
    let (shown, more) = found.shown();
    for item in shown {
        if let Some(source) = found.sources.get(item.source) {
            paragraphs.push(renderer.render(&[group(item, source)]));
        }
    }
    if more > 0 {
        paragraphs.push(format!("and {more} more"));
    }
    let errors = found.errors().count();
    if errors > 1 {
        paragraphs.push(format!("{errors} errors"));
    }
    paragraphs.join("\n\n")
}

fn group<'a>(item: &'a Diagnostic, source: &'a Source) -> Group<'a> {
    let level = match item.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    let end = source.text.len();
    // A mark must not reach over the line end, or it is drawn over two lines.
    let clamp = |span: &std::ops::Range<usize>| {
        let start = span.start.min(end);
        let visible = source.excerpt(&(start..span.end.min(end))).trim_end().len();
        start..start + visible
    };
    let mut snippet = Snippet::source(source.text.as_str())
        .path(source.name.as_str())
        .fold(true)
        .annotation(AnnotationKind::Primary.span(clamp(&item.span)));
    for related in &item.related {
        snippet = snippet.annotation(
            AnnotationKind::Context.span(clamp(&related.span)).label(related.label.as_str()),
        );
    }
    let group = level.primary_title(item.message.as_str()).element(snippet);
    match &item.hint {
        Some(hint) => group.element(Level::HELP.message(hint.as_str())),
        None => group,
    }
}
