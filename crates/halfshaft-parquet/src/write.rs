//! From an answer to the bytes of a Parquet file.

use std::sync::Arc;

use halfshaft_results::{Answer, Table, column_names, io::tables_of};
use parquet::basic::{Encoding, Repetition, Type as PhysicalType};
use parquet::data_type::{DoubleType, Int32Type};
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::{Type, TypePtr};

use crate::{ANSWER_KEY, ParquetError, TABLE_COLUMN, UNITS_KEY};

/// The answer as the bytes of a Parquet file.
///
/// # Errors
/// [`ParquetError::NoTable`] for answers without tables; errors of the Parquet library, which
/// memory does not give.
pub fn to_bytes(answer: &Answer) -> Result<Vec<u8>, ParquetError> {
    let tables: Vec<Table> = tables_of(answer).into_iter().map(|(_, table)| table).collect();
    let names = column_names(&tables);
    if tables.is_empty() || names.is_empty() {
        return Err(ParquetError::NoTable { analysis: answer.header().analysis.clone() });
    }
    let properties = WriterProperties::builder()
        .set_dictionary_enabled(false)
        .set_encoding(Encoding::PLAIN)
        .set_key_value_metadata(Some(metadata(answer, &names)?))
        .build();
    let mut writer = SerializedFileWriter::new(Vec::new(), schema(&names)?, Arc::new(properties))?;
    for (number, table) in (1..).zip(&tables) {
        let mut group = writer.next_row_group()?;
        write_table(&mut group, number, table, &names)?;
        group.close()?;
    }
    Ok(writer.into_inner()?)
}

fn metadata(answer: &Answer, names: &[(String, String)]) -> Result<Vec<KeyValue>, ParquetError> {
    let mut skeleton = answer.clone();
    for columns in skeleton.bulk_mut() {
        columns.iter_mut().for_each(|column| column.values = Vec::new());
    }
    let units: serde_json::Map<String, serde_json::Value> =
        names.iter().map(|(name, unit)| (name.clone(), unit.clone().into())).collect();
    Ok(vec![
        KeyValue::new(ANSWER_KEY.to_owned(), serde_json::to_string(&skeleton)?),
        KeyValue::new(UNITS_KEY.to_owned(), serde_json::to_string(&units)?),
    ])
}

fn schema(names: &[(String, String)]) -> Result<TypePtr, ParquetError> {
    let field = |name: &str, kind| -> Result<TypePtr, ParquetError> {
        let builder = Type::primitive_type_builder(name, kind);
        Ok(Arc::new(builder.with_repetition(Repetition::REQUIRED).build()?))
    };
    let mut fields = vec![field(TABLE_COLUMN, PhysicalType::INT32)?];
    for (name, _) in names {
        fields.push(field(name, PhysicalType::DOUBLE)?);
    }
    Ok(Arc::new(Type::group_type_builder("halfshaft").with_fields(fields).build()?))
}

fn write_table(
    group: &mut SerializedRowGroupWriter<'_, Vec<u8>>,
    number: i32,
    table: &Table,
    names: &[(String, String)],
) -> Result<(), ParquetError> {
    let rows = table.rows();
    if let Some(mut column) = group.next_column()? {
        column.typed::<Int32Type>().write_batch(&vec![number; rows], None, None)?;
        column.close()?;
    }
    for values in table.values_of(names.iter().map(|(name, _)| name.as_str())) {
        let Some(mut column) = group.next_column()? else { break };
        let mut values = values.to_vec();
        values.resize(rows, f64::NAN);
        column.typed::<DoubleType>().write_batch(&values, None, None)?;
        column.close()?;
    }
    Ok(())
}
