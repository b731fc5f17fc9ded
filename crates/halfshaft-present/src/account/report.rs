//! What is told of everything together: the findings, and the methods side by side. Each analysis has
//! its own account.

use halfshaft_results::ReportResult;

use super::Account;
use crate::findings::{self, Finding};

/// The whole account.
pub(crate) fn account(report: &ReportResult) -> Account {
    let mut account = Account::default();
    let findings = findings::of(report);
    account.text([findings::headline(&findings)]);
    account.list(findings.iter().map(Finding::line).collect());
    account.append(super::levels::account(report));
    account
}
