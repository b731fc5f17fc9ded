//! The report in a headless browser: its figures draw, nothing complains, nothing is fetched.

use std::fs;
use std::process::Command;

use crate::run::{Outcome, finish, halfshaft, has, target};

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
    let output = Command::new(browser)
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"])
        .args(["--disable-background-networking", "--disable-component-update", "--disable-sync"])
        .args(["--enable-logging=stderr", "--virtual-time-budget=20000", "--window-size=1200,9000"])
        .arg(format!("--user-data-dir={}", folder.join("profile").display()))
        .arg("--dump-dom")
        .arg(format!("file://{}", page.display()))
        .output()
        .map_err(|error| format!("{browser}: {error}"))?;
    judge(&String::from_utf8_lossy(&output.stdout), &String::from_utf8_lossy(&output.stderr))
}

fn judge(dom: &str, log: &str) -> Outcome {
    let figures = dom.matches("js-plotly-plot").count();
    if figures < 5 {
        return Err(format!("only {figures} interactive figures were drawn:\n{log}"));
    }
    let complaints: Vec<&str> = log.lines().filter(|line| line.contains("CONSOLE")).collect();
    if !complaints.is_empty() {
        return Err(format!("the page complains:\n{}", complaints.join("\n")));
    }
    println!("report: {figures} interactive figures drawn, no complaint");
    Ok(())
}

fn find_browser() -> Option<&'static str> {
    let present = || BROWSERS.iter().copied().find(|browser| has(browser, &["--version"]));
    present().or_else(|| {
        println!("installing a browser");
        let install =
            "apt-get update -qq && apt-get install -y -qq --no-install-recommends chromium";
        let installed = Command::new("bash")
            .args(["-c", &format!("({install}) >/dev/null 2>&1")])
            .status()
            .is_ok_and(|status| status.success());
        if installed { present() } else { None }
    })
}
