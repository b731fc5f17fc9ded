//! What is generated and committed: schema, reference pages, the example's figures, README output.
//!
//! Texts must be equal to the letter. Pictures are compared number by number, since the last
//! digit of a cosine differs between machines. A file that is no longer generated is stale as well.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::readme;
use crate::run::{Outcome, finish, halfshaft, root, target};

/// Largest distance between two numbers of a picture, in points, that is still the same picture.
const SAME_POINT: f64 = 0.03;

/// Folders that hold nothing but generated files. The reference pages stand among others.
const FOLDERS: [&str; 3] = ["docs/pictures", "schema", "examples/two-mass-driveline/figures"];

/// Writes everything into the tree.
pub fn write() -> Outcome {
    produce(&root())?;
    readme::update()
}

/// Makes everything anew elsewhere and compares.
pub fn check() -> Outcome {
    let fresh = target().join("generated");
    let _ = fs::remove_dir_all(&fresh);
    produce(&fresh)?;
    let mut stale = Vec::new();
    compare(&fresh, &fresh, &mut stale);
    for folder in FOLDERS {
        left_over(&fresh.join(folder), &root().join(folder), &mut stale);
    }
    if stale.is_empty() {
        println!("generated files: up to date");
        return Ok(());
    }
    Err(format!("run `cargo xtask generate`, these are stale:\n  {}", stale.join("\n  ")))
}

/// Makes all generated files below a folder that stands for the root.
fn produce(folder: &Path) -> Outcome {
    let program = halfshaft()?;
    let make = |arguments: &[&str]| {
        finish(
            Command::new(&program).current_dir(root()).args(arguments).arg("--quiet"),
            &format!("halfshaft {}", arguments.join(" ")),
        )
    };
    let path = |name: &str| folder.join(name).display().to_string();
    for needed in FOLDERS {
        fs::create_dir_all(folder.join(needed)).map_err(|error| format!("{needed}: {error}"))?;
    }
    for of in ["model", "study"] {
        let output = Command::new(&program)
            .args(["schema", of])
            .output()
            .map_err(|error| format!("halfshaft schema: {error}"))?;
        let name = format!("schema/halfshaft-{of}.schema.json");
        fs::write(folder.join(&name), output.stdout).map_err(|error| format!("{name}: {error}"))?;
    }
    make(&["reference", &path("docs")])?;
    let figures = path("examples/two-mass-driveline/figures");
    make(&["run", "examples/two-mass-driveline/paper.toml", "--out", &figures])?;
    // Everything of the study but the page and the data, which are large and made by one command.
    for bulky in ["study.html", "study.json"] {
        let _ = fs::remove_file(Path::new(&figures).join(bulky));
    }
    make(&["static", "--out", &path("docs/pictures/static.svg")])?;
    make(&["shock", "--compare", "--duration", "2s", "--out", &path("docs/pictures/shock.svg")])?;
    let scaled = "examples/two-mass-driveline/scaled.toml";
    let picture = path("docs/pictures/resonance.svg");
    make(&["resonance", scaled, "--method", "averaged", "--verify", "--out", &picture])?;
    let plane = "excitation.amplitude=1..20";
    let folds = path("docs/pictures/folds.svg");
    make(&["folds", scaled, "--method", "averaged", "--parameter", plane, "--out", &folds])?;
    let engine = "examples/engine-and-driveline/line.toml";
    make(&["campbell", engine, "--this-gear", "--out", &path("docs/pictures/campbell.svg")])?;
    let one = ["--this-gear", "--shaft", "web 3", "--orders", "2,4,4.5,6"];
    let picture = path("docs/pictures/forced.svg");
    make(&[&["forced", engine], &one[..], &["--node", "pulley", "--out", &picture]].concat())?;
    make(&["check", "--out", &path("docs/pictures/line.svg")])
}

/// Compares every file below `folder` with its twin in the tree.
fn compare(fresh: &Path, folder: &Path, stale: &mut Vec<String>) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            compare(fresh, &path, stale);
            continue;
        }
        let name = path.strip_prefix(fresh).unwrap_or(&path).to_path_buf();
        if !same(&path, &root().join(&name)) {
            stale.push(name.display().to_string());
        }
    }
}

/// Notes the files of a generated folder that are no longer generated.
fn left_over(fresh: &Path, committed: &Path, stale: &mut Vec<String>) {
    for entry in fs::read_dir(committed).into_iter().flatten().flatten() {
        let path = entry.path();
        let twin = fresh.join(entry.file_name());
        if path.is_dir() {
            left_over(&twin, &path, stale);
        } else if !twin.is_file() {
            let name = path.strip_prefix(root()).unwrap_or(&path).display();
            stale.push(format!("{name} (no longer generated: remove it)"));
        }
    }
}

fn same(fresh: &Path, committed: &Path) -> bool {
    let ending = fresh.extension().and_then(|ending| ending.to_str()).unwrap_or_default();
    match ending {
        // The pixels follow from the same drawing as the SVG beside them.
        "png" => committed.is_file(),
        _ => match (fs::read_to_string(fresh), fs::read_to_string(committed)) {
            (Ok(fresh), Ok(committed)) if ending == "svg" => same_drawing(&fresh, &committed),
            (Ok(fresh), Ok(committed)) => fresh == committed,
            _ => false,
        },
    }
}

/// Whether two texts differ in nothing but the last digits of numbers.
fn same_drawing(a: &str, b: &str) -> bool {
    let (a, b) = (pieces(a), pieces(b));
    a.len() == b.len()
        && a.iter().zip(&b).all(|(a, b)| match (a.parse::<f64>(), b.parse::<f64>()) {
            (Ok(a), Ok(b)) => (a - b).abs() <= SAME_POINT,
            _ => a == b,
        })
}

/// Numbers and what stands between them.
fn pieces(text: &str) -> Vec<&str> {
    let numeric = |c: char| c.is_ascii_digit() || c == '.' || c == '-';
    let mut pieces = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let inside = numeric(first);
        let end = rest.find(|c| numeric(c) != inside).unwrap_or(rest.len());
        pieces.push(&rest[..end]);
        rest = &rest[end..];
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_that_are_no_longer_generated_are_noticed() {
        let folder = target().join(format!("generate-test-{}", std::process::id()));
        let (fresh, committed) = (folder.join("fresh"), folder.join("committed"));
        for file in [fresh.join("a"), committed.join("a"), committed.join("old/b")] {
            fs::create_dir_all(file.parent().expect("has one")).expect("makes");
            fs::write(file, "").expect("writes");
        }
        let mut stale = Vec::new();
        left_over(&fresh, &committed, &mut stale);
        fs::remove_dir_all(&folder).expect("removes");
        assert_eq!(stale.len(), 1, "{stale:?}");
        assert!(stale[0].contains("b (no longer generated"), "{stale:?}");
    }
}
