//! From the bytes of a Parquet file to the answer.

use std::collections::HashMap;

use bytes::Bytes;
use halfshaft_results::{Answer, Column};
use parquet::column::reader::ColumnReader;
use parquet::file::reader::{FileReader, RowGroupReader, SerializedFileReader};

use crate::{ANSWER_KEY, ParquetError};

/// Reads an answer that [`crate::to_bytes`] wrote; it compares equal to the original.
///
/// # Errors
/// [`ParquetError`] where the bytes are no Parquet file or none of halfshaft.
pub fn from_bytes(bytes: Vec<u8>) -> Result<Answer, ParquetError> {
    let reader = SerializedFileReader::new(Bytes::from(bytes))?;
    let metadata = reader.metadata().file_metadata();
    let text = metadata
        .key_value_metadata()
        .into_iter()
        .flatten()
        .find(|entry| entry.key == ANSWER_KEY)
        .and_then(|entry| entry.value.as_deref())
        .ok_or(ParquetError::NotOurs)?;
    let mut answer: Answer = serde_json::from_str(text)?;
    let positions: HashMap<String, usize> = metadata
        .schema_descr()
        .columns()
        .iter()
        .map(|column| column.name().to_owned())
        .zip(0..)
        .collect();
    for (index, columns) in answer.bulk_mut().into_iter().enumerate() {
        if index >= reader.num_row_groups() {
            return Err(ParquetError::Missing { what: format!("table {}", index + 1) });
        }
        let group = reader.get_row_group(index)?;
        for column in columns.iter_mut() {
            fill(column, group.as_ref(), &positions)?;
        }
    }
    Ok(answer)
}

fn fill(
    column: &mut Column,
    group: &dyn RowGroupReader,
    positions: &HashMap<String, usize>,
) -> Result<(), ParquetError> {
    let missing = || ParquetError::Missing { what: format!("the column \"{}\"", column.name) };
    let position = positions.get(&column.name).ok_or_else(missing)?;
    let rows = usize::try_from(group.metadata().num_rows()).unwrap_or(0);
    let ColumnReader::DoubleColumnReader(mut reader) = group.get_column_reader(*position)? else {
        return Err(missing());
    };
    let mut values = Vec::with_capacity(rows);
    reader.read_records(rows, None, None, &mut values)?;
    column.values = values;
    Ok(())
}
