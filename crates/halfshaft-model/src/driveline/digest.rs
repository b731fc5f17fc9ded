//! Fingerprint of a line's values.

use std::fmt::Write as _;

use sha2::{Digest, Sha256};

use super::Driveline;

/// SHA-256 of the line's JSON form, in hexadecimal.
pub(super) fn of(line: &Driveline) -> String {
    // A line is plain numbers and texts, which JSON can always hold.
    let json = serde_json::to_vec(line).unwrap_or_default();
    Sha256::digest(&json).iter().fold(String::with_capacity(64), |mut text, byte| {
        // Writing to a String cannot fail.
        let _ = write!(text, "{byte:02x}");
        text
    })
}
