//! The comparisons of a study as tables of text.

use std::fmt::Write as _;

use crate::StudyResult;

/// Comparisons as CSV: figure, what, printed, recomputed, difference, remark.
pub fn comparison_csv(study: &StudyResult) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    // Writing to memory cannot fail.
    let _ =
        writer.write_record(["figure", "what", "printed", "recomputed", "difference", "remark"]);
    for row in &study.comparisons {
        let _ = writer.write_record([
            &row.figure,
            &row.what,
            &row.printed,
            &row.recomputed,
            &row.difference,
            &row.remark,
        ]);
    }
    writer.into_inner().ok().and_then(|bytes| String::from_utf8(bytes).ok()).unwrap_or_default()
}

/// Comparisons as a Markdown page with one table.
pub fn comparison_markdown(study: &StudyResult) -> String {
    let mut page = format!("# {}\n\n", study.header.model.name);
    if !study.description.is_empty() {
        let _ = write!(page, "{}\n\n", study.description);
    }
    page.push_str("| figure | what | printed | recomputed | difference | remark |\n");
    page.push_str("|---|---|---|---|---|---|\n");
    for row in &study.comparisons {
        let cells =
            [&row.figure, &row.what, &row.printed, &row.recomputed, &row.difference, &row.remark];
        let cells: Vec<String> = cells.iter().map(|cell| cell.replace('|', "\\|")).collect();
        // Writing to a String cannot fail.
        let _ = writeln!(page, "| {} |", cells.join(" | "));
    }
    page
}
