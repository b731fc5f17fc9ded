//! JSON text of an answer and back.

use crate::Answer;

/// Why a JSON text is no answer.
#[derive(Debug, thiserror::Error)]
#[error("this is no result of halfshaft: {0}")]
pub struct ReadError(#[from] serde_json::Error);

/// Why an answer cannot be written as JSON.
#[derive(Debug, thiserror::Error)]
#[error("the result cannot be written as JSON: {0}")]
pub struct JsonError(#[from] serde_json::Error);

/// The answer as JSON, indented by two spaces where `pretty`.
///
/// # Errors
/// [`JsonError`] where a value has no form in JSON, which no answer has.
pub fn to_json(answer: &Answer, pretty: bool) -> Result<String, JsonError> {
    let text =
        if pretty { serde_json::to_string_pretty(answer)? } else { serde_json::to_string(answer)? };
    Ok(text)
}

/// Writes the answer as JSON, indented by two spaces, with a line end at the end.
///
/// # Errors
/// Where the writer fails.
pub fn write_json(answer: &Answer, mut file: impl std::io::Write) -> std::io::Result<()> {
    serde_json::to_writer_pretty(&mut file, answer)?;
    file.write_all(b"\n")
}

/// Reads the JSON of an answer; every number comes back to the last bit.
///
/// # Errors
/// [`ReadError`] where the text is no answer.
pub fn from_json(text: &str) -> Result<Answer, ReadError> {
    Ok(serde_json::from_str(text)?)
}
