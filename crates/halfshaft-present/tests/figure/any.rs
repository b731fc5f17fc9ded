//! Any description gives a figure: random values, lengths, texts and sizes.
//!
//! Oracle of every test here: the promise that nothing panics, the XML and JSON readers, and the PNG
//! decoder.

use halfshaft_present::figure::{
    Axis, Colour, Curve, Figure, Item, Label, LegendPlace, Line, Marker, Panel, Points, Reference,
    Region, Scale, Secondary, Size, plotly, png, svg,
};
use proptest::collection::vec;
use proptest::option;
use proptest::prelude::{
    Just, ProptestConfig, Strategy, any, prop_assert, prop_assert_eq, prop_oneof, proptest,
};
use serde_json::Value;

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -10.0..10.0_f64,
        1 => any::<f64>(),
        1 => Just(0.0),
        1 => prop_oneof![Just(f64::NAN), Just(f64::INFINITY), Just(1e300), Just(-1e300), Just(5e-324)],
    ]
}

fn words() -> impl Strategy<Value = String> {
    prop_oneof![
        Just(String::new()),
        "[a-zA-Zθ_^{}\\\\ ]{1,20}",
        any::<String>(),
        Just("<&\"'>]]>\u{0}\u{ffff}\u{2028}".to_owned()),
    ]
}

fn axis() -> impl Strategy<Value = Axis> {
    let second = (words(), words(), number(), number());
    let second =
        second.prop_map(|(label, unit, factor, offset)| Secondary { label, unit, factor, offset });
    (words(), words(), option::of((number(), number())), any::<bool>(), option::of(second))
        .prop_map(|(label, unit, range, log, secondary)| {
            let scale = if log { Scale::Log } else { Scale::Linear };
            let names =
                if log { vec![(0.5, label.clone()), (f64::NAN, unit.clone())] } else { Vec::new() };
            Axis { label, unit, range, scale, secondary, names }
        })
}

fn item() -> impl Strategy<Value = Item> {
    let data = (words(), vec(number(), 0..12), vec(number(), 0..12));
    let of = |kind: u32, (name, x, y): (String, Vec<f64>, Vec<f64>), value: f64| -> Item {
        let colour = Colour::index(kind as usize);
        let marker = [Marker::Circle, Marker::Cross, Marker::Star][kind as usize % 3];
        match kind {
            0 => Curve { width: value, ..Curve::new(name, x, y, colour) }.into(),
            1 => Curve::new(name, x, y, colour).with_line(Line::DashDot).into(),
            2 => {
                let labels = vec![name.clone(); 3];
                let points =
                    Points::new(name, x, y, colour).with_marker(marker).with_labels(labels);
                Points { size: value, ..points }.into()
            }
            3 => Region { opacity: value, ..Region::new(name, x, y, colour) }.into(),
            4 => Reference::horizontal(value, name, colour).into(),
            5 => Reference::vertical(value, name, colour).into(),
            _ => Label::new(value, value, name).into(),
        }
    };
    (0..7_u32, data, number()).prop_map(move |(kind, data, value)| of(kind, data, value))
}

fn panel() -> impl Strategy<Value = Panel> {
    let legend = prop_oneof![Just(LegendPlace::Auto), Just(LegendPlace::Below)];
    (axis(), axis(), vec(item(), 0..6), legend, number()).prop_map(
        |(x, y, items, legend, height)| Panel {
            items,
            height_share: height,
            ..Panel::new(x, y).with_legend(legend)
        },
    )
}

fn figure() -> impl Strategy<Value = Figure> {
    let size = prop_oneof![
        Just(Size::Single),
        Just(Size::Column),
        (number(), number()).prop_map(|(width, height)| Size::Points { width, height }),
    ];
    (words(), words(), vec(panel(), 0..4), size).prop_map(|(id, title, panels, size)| Figure {
        id,
        caption: title.clone(),
        title,
        panels,
        size,
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn svg_is_well_formed(figure in figure(), embed_in_html in any::<bool>()) {
        let text = svg::render(&figure, &svg::SvgOptions { embed_in_html });
        prop_assert!(roxmltree::Document::parse(&text).is_ok(), "{text}");
    }

    #[test]
    fn plotly_value_reads_back(figure in figure()) {
        let value = plotly::figure_json(&figure);
        let read: Value = serde_json::from_str(&plotly::script_json(&value)).unwrap();
        prop_assert_eq!(&read, &value);
        for (name, axis) in value["layout"].as_object().unwrap() {
            if name.starts_with("xaxis") || name.starts_with("yaxis") {
                let range = axis.get("range").and_then(Value::as_array);
                prop_assert!(range.is_none_or(|range| range.iter().all(Value::is_number)), "{axis}");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn pictures_are_drawn(figure in figure()) {
        let bytes = png::render(&figure, 0.3).unwrap();
        prop_assert!(tiny_skia::Pixmap::decode_png(&bytes).is_ok());
    }
}
