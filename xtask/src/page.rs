//! The report in a headless browser: its figures draw, nothing complains, nothing is fetched.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::run::{Outcome, apt_install, finish, halfshaft, has, target};

const BROWSERS: &[&str] = &["chromium", "chromium-browser", "google-chrome"];

/// Opens the report of the embedded example; installs Debian's Chromium where that is possible.
pub fn run() -> Outcome {
    let Some(browser) = find_browser() else {
        println!("no browser here and none can be installed: the page is not tested");
        return Ok(());
    };
    let folder = target().join("page");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    let page = folder.join("report.html");
    let program = halfshaft()?;
    finish(
        Command::new(program).args(["report", "--quiet", "--out"]).arg(&page),
        "halfshaft report",
    )?;
    Opened::by(browser, &page)?.complains()?;
    let whole = folder.join("every-figure.html");
    let text = fs::read_to_string(&page).map_err(|error| format!("{}: {error}", page.display()))?;
    fs::write(&whole, without_watching(&text))
        .map_err(|error| format!("{}: {error}", whole.display()))?;
    every_figure(&Opened::by(browser, &whole)?, text.matches("<figure class=\"plot").count())
}

/// The page for a browser that cannot tell what the reader is near: it draws every figure while it
/// loads, so that what is counted does not depend on how fast this machine scrolls and paints.
fn without_watching(page: &str) -> String {
    page.replacen("<head>", "<head><script>delete window.IntersectionObserver;</script>", 1)
}

fn every_figure(page: &Opened, figures: usize) -> Outcome {
    page.complains()?;
    let drawn = page.drawn();
    if figures < 5 || drawn != figures {
        return Err(format!("{drawn} of {figures} interactive figures were drawn:\n{}", page.log));
    }
    println!("report: {figures} interactive figures drawn, no complaint");
    Ok(())
}

/// What a browser made of a page: its elements after its scripts ran, and what it said.
struct Opened {
    dom: String,
    log: String,
}

impl Opened {
    fn by(browser: &str, page: &Path) -> Result<Self, String> {
        let output = Command::new(browser)
            .args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic"])
            .args(["--no-first-run", "--disable-background-networking", "--disable-sync"])
            .args(["--disable-component-update", "--enable-logging=stderr"])
            .args(["--virtual-time-budget=20000", "--window-size=1200,9000", "--dump-dom"])
            .arg(format!("--user-data-dir={}", page.with_extension("profile").display()))
            .arg(format!("file://{}", page.display()))
            .output()
            .map_err(|error| format!("{browser}: {error}"))?;
        Ok(Self {
            dom: String::from_utf8_lossy(&output.stdout).into_owned(),
            log: String::from_utf8_lossy(&output.stderr).into_owned(),
        })
    }

    fn drawn(&self) -> usize {
        self.dom.matches("<figure class=\"plot drawn\"").count()
    }

    fn complains(&self) -> Outcome {
        let complaints: Vec<&str> =
            self.log.lines().filter(|line| line.contains("CONSOLE")).collect();
        if complaints.is_empty() {
            return Ok(());
        }
        Err(format!("the page complains:\n{}", complaints.join("\n")))
    }
}

fn find_browser() -> Option<&'static str> {
    let present = || BROWSERS.iter().copied().find(|browser| has(browser, &["--version"]));
    present().or_else(|| {
        println!("installing a browser");
        let installed = apt_install("chromium");
        if installed { present() } else { None }
    })
}
