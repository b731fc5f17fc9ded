//! Data for plotly.js.

use halfshaft_present::figure::plotly::{BUNDLE, DRAW, figure_json, script_json};
use halfshaft_present::figure::{Axis, Colour, Curve, Figure, Panel, Reference, escape};
use serde_json::Value;

use super::samples::{HOSTILE, one_of_each};

fn numbers(value: &Value) -> Vec<Option<f64>> {
    let values = value.as_array().expect("an array of numbers");
    values.iter().map(Value::as_f64).collect()
}

/// Oracle: the JSON reader: what is written into a page reads back as the same value.
#[test]
fn the_value_survives_a_round_trip_through_a_page() {
    let value = figure_json(&one_of_each(&escape(HOSTILE)));
    let text = script_json(&value);
    assert!(!text.contains('<') && !text.contains('&'));
    assert_eq!(serde_json::from_str::<Value>(&text).unwrap(), value);
}

/// Oracle: the texts that plotly would act on: tags, entities, templates, formulas.
#[test]
fn hostile_text_stays_text() {
    fn texts(value: &Value, found: &mut Vec<String>) {
        match value {
            Value::String(text) => found.push(text.clone()),
            Value::Array(values) => values.iter().for_each(|value| texts(value, found)),
            Value::Object(map) => map.values().for_each(|value| texts(value, found)),
            _ => {}
        }
    }
    let value = figure_json(&one_of_each(&escape(HOSTILE)));
    let mut found = Vec::new();
    texts(&value["data"], &mut found);
    texts(&value["layout"]["annotations"], &mut found);
    texts(&value["layout"]["xaxis"]["title"], &mut found);
    assert!(found.iter().any(|text| text.contains("&lt;script&gt;")));
    for text in found {
        assert!(!text.contains("<script") && !text.contains('$'), "{text}");
        let templates = text.matches("%{").count();
        let own = ["%{x:.6~g}", "%{y:.6~g}", "%{text}"];
        assert_eq!(
            templates,
            own.map(|own| text.matches(own).count()).iter().sum::<usize>(),
            "{text}"
        );
    }
}

/// Oracle: the definition: values that are not finite become gaps, and nothing else does.
#[test]
fn gaps_are_null() {
    let (x, y) =
        (vec![0.0, 1.0, f64::NAN, 3.0, 4.0], vec![0.0, f64::INFINITY, 2.0, 3.0, 1.0 / 3.0]);
    let panel =
        Panel::new(Axis::default(), Axis::default()).with(Curve::new("c", x, y, Colour::Blue));
    let value = figure_json(&Figure::new("f", "").with(panel));
    let trace = &value["data"][0];
    assert_eq!(numbers(&trace["x"]), [Some(0.0), None, None, Some(3.0), Some(4.0)]);
    assert_eq!(numbers(&trace["y"]), [Some(0.0), None, None, Some(3.0), Some(0.333_333_33)]);
    assert_eq!(trace["line"]["simplify"], false);
}

/// Oracle: the definition of `by_stability`: several traces, one group, one entry of the legend.
#[test]
fn a_branch_is_shown_and_hidden_as_one() {
    let x = [0.0, 1.0, 2.0, 3.0];
    let branch = Curve::by_stability("branch", &x, &x, &[true, true, false, false], Colour::Blue);
    let panel = Panel::new(Axis::default(), Axis::default()).with_all(branch);
    let value = figure_json(&Figure::new("f", "").with(panel));
    let traces = value["data"].as_array().unwrap();
    assert_eq!(traces.len(), 2);
    assert!(traces.iter().all(|trace| trace["legendgroup"] == traces[0]["legendgroup"]));
    assert_eq!(traces.iter().filter(|trace| trace["showlegend"] == true).count(), 1);
    assert_ne!(traces[0]["line"]["dash"], traces[1]["line"]["dash"]);
}

/// Oracle: the definition of the secondary axis: rpm = 30/π rad/s at both ends, and a link by which
/// the page keeps it so.
#[test]
fn a_secondary_axis_has_the_matching_range() {
    let factor = 30.0 / std::f64::consts::PI;
    let x = Axis::new("Ω", "rad/s").with_range(10.0, 20.0).with_secondary("n", "rpm", factor);
    let value = figure_json(&Figure::new("f", "").with(Panel::new(x, Axis::default())));
    let layout = &value["layout"];
    assert_eq!(numbers(&layout["xaxis2"]["range"]), [Some(10.0 * factor), Some(20.0 * factor)]);
    assert_eq!(layout["xaxis2"]["overlaying"], "x");
    let link = &layout["meta"]["linked"][0];
    assert_eq!((&link["axis"], &link["of"]), (&"xaxis2".into(), &"xaxis".into()));
    assert!(DRAW.contains("function halfshaftDraw(element, figure)"));
}

/// Oracle: the layout asked for: stacked panels, the upper one first, over one horizontal axis.
#[test]
fn panels_with_equal_axes_share_one() {
    let curve = |to: f64| Curve::new("c", vec![0.0, to], vec![0.0, 1.0], Colour::Blue);
    let panel = |to: f64| Panel::new(Axis::new("Time", "s"), Axis::new("y", "")).with(curve(to));
    let value = figure_json(&Figure::new("f", "").with(panel(2.0)).with(panel(5.0)));
    let layout = &value["layout"];
    assert_eq!(numbers(&layout["xaxis"]["range"]), [Some(0.0), Some(5.0)]);
    assert!(layout.get("xaxis2").is_none());
    assert_eq!(
        (&value["data"][0]["yaxis"], &value["data"][1]["yaxis"]),
        (&"y".into(), &"y2".into())
    );
    let (upper, lower) =
        (numbers(&layout["yaxis"]["domain"]), numbers(&layout["yaxis2"]["domain"]));
    assert!(lower[0] == Some(0.0) && lower[1] < upper[0] && upper[1] == Some(1.0));
}

/// Oracle: plotly's rules: on a logarithmic axis shapes count in values, annotations and ranges in
/// powers of ten.
#[test]
fn logarithmic_places_follow_the_rules_of_plotly() {
    let x = Axis::new("f", "Hz").logarithmic().with_range(1.0, 1000.0);
    let line = Reference::vertical(100.0, "mode", Colour::DANGER);
    let value = figure_json(&Figure::new("f", "").with(Panel::new(x, Axis::default()).with(line)));
    let layout = &value["layout"];
    assert_eq!(numbers(&layout["xaxis"]["range"]), [Some(0.0), Some(3.0)]);
    let line = layout["shapes"].as_array().unwrap().iter().find(|shape| shape["type"] == "line");
    assert_eq!(line.unwrap()["x0"], 100.0);
    assert_eq!(layout["annotations"][0]["x"], 2.0);
}

/// Oracle: the file's own first lines, and the rule that no script may end early inside a page.
#[test]
fn the_bundle_is_whole() {
    assert!(BUNDLE[..200].contains("plotly.js (basic - minified) v4.1.1"));
    assert!(BUNDLE.len() > 1_000_000 && !BUNDLE.contains("</script"));
    assert!(!DRAW.contains("</script"));
}

/// Oracle: the stated bound: a million points become at most the budget of 20,000 and its last
/// coarsening.
#[test]
fn long_curves_are_thinned() {
    let x: Vec<f64> = (0..1_000_000).map(f64::from).collect();
    let y = x.iter().map(|x| (1e-3 * x).sin()).collect();
    let panel =
        Panel::new(Axis::default(), Axis::default()).with(Curve::new("c", x, y, Colour::Blue));
    let value = figure_json(&Figure::new("f", "").with(panel));
    let kept = numbers(&value["data"][0]["x"]);
    assert!((500..=25_000).contains(&kept.len()), "{}", kept.len());
    assert_eq!((kept[0], kept[kept.len() - 1]), (Some(0.0), Some(999_999.0)));
}
