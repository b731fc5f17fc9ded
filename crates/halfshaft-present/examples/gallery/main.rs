//! Writes sample figures to a folder: `cargo run --example gallery -- FOLDER`.
//!
//! Every figure comes as SVG and PNG; `gallery.html` shows all of them as interactive graphs, with
//! the plotly bundle inside, so that it needs no network. The data are closed forms.

use std::error::Error;
use std::path::{Path, PathBuf};

use halfshaft_present::figure::{Figure, plotly, png, svg};

mod degenerate;
mod dynamics;
mod statics;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args_os().nth(1).map(PathBuf::from).ok_or("which folder?")?;
    std::fs::create_dir_all(&folder)?;
    let mut figures = vec![
        dynamics::resonance(),
        dynamics::decay(),
        dynamics::dense_record(),
        dynamics::compliance(),
        statics::windup(),
        statics::fold_curve(),
        statics::fine_scale(),
    ];
    figures.extend(degenerate::figures());
    for figure in &figures {
        write(figure, &folder)?;
    }
    std::fs::write(folder.join("gallery.html"), page(&figures))?;
    Ok(())
}

fn write(figure: &Figure, folder: &Path) -> Result<(), Box<dyn Error>> {
    let text = svg::render(figure, &svg::SvgOptions::default());
    std::fs::write(folder.join(format!("{}.svg", figure.id)), text)?;
    let picture = png::render(figure, png::DEFAULT_SCALE)?;
    std::fs::write(folder.join(format!("{}.png", figure.id)), picture)?;
    Ok(())
}

fn page(figures: &[Figure]) -> String {
    let bundle = plotly::BUNDLE;
    let draw = plotly::DRAW;
    let mut page = format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <title>Gallery</title>\n<style>body{{margin:0 auto;max-width:52rem;padding:0 .5rem}}\
         </style>\n<script>{bundle}</script>\n<script>{draw}</script></head><body>\n"
    );
    for figure in figures {
        let json = plotly::script_json(&plotly::figure_json(figure));
        let id = &figure.id;
        page += &format!(
            "<div id=\"{id}\"></div>\n<script>halfshaftDraw(document.getElementById(\"{id}\"), \
             {json});</script>\n"
        );
    }
    page + "</body></html>\n"
}
