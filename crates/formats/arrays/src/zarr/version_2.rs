//! Metadata of zarr version 2: `.zarray`.

use serde_json::Value;

use super::array::{ZarrArray, lengths};
use super::codecs::Codec;
use super::fill::fill;
use crate::error::Problem;
use crate::fields::Item;
use crate::limits;
use crate::literal::Literal;

pub(crate) fn array(metadata: &Value) -> Result<ZarrArray, Problem> {
    if metadata["zarr_format"] != 2 {
        return Err(Problem::damaged(
            0,
            format!("`zarr_format`: {}", metadata["zarr_format"]),
            "2",
        ));
    }
    let item = Item::from_descr(&literal(&metadata["dtype"], 0)?)?;
    let chunk = lengths(&metadata["chunks"], "chunks")?;
    let mut codecs = Vec::new();
    match metadata["order"].as_str() {
        Some("C") => {}
        Some("F") => codecs.push(Codec::Transposed((0..chunk.len()).rev().collect())),
        _ => {
            return Err(Problem::damaged(
                0,
                format!("`order`: {}", metadata["order"]),
                "`C` or `F`",
            ));
        }
    }
    let filters = metadata["filters"].as_array();
    if let Some(filter) = filters.and_then(|filters| filters.first()) {
        return Err(Problem::unsupported(
            format!("a filter `{}`", filter["id"].as_str().unwrap_or("?")),
            "write it without filters",
        ));
    }
    if !metadata["compressor"].is_null() {
        codecs.push(Codec::from_name(
            metadata["compressor"]["id"].as_str().unwrap_or("?"),
        )?);
    }
    let separator = match metadata.get("dimension_separator").and_then(Value::as_str) {
        Some("/") => '/',
        _ => '.',
    };
    ZarrArray {
        name: String::new(),
        shape: lengths(&metadata["shape"], "shape")?,
        chunk,
        fill: fill(&metadata["fill_value"], &item),
        item,
        codecs,
        prefix: "",
        separator,
    }
    .check()
}

/// Converts a `dtype` in JSON to the literal that NumPy writes.
fn literal(value: &Value, depth: usize) -> Result<Literal, Problem> {
    let wrong = || Problem::damaged(0, format!("`dtype`: {value}"), "a type of NumPy");
    match value {
        _ if depth > limits::LITERAL_DEPTH => Err(wrong()),
        Value::String(name) => Ok(Literal::Text(name.clone())),
        Value::Number(number) => number.as_u64().map(Literal::Whole).ok_or_else(wrong),
        Value::Array(all) => {
            let all: Result<Vec<Literal>, Problem> =
                all.iter().map(|value| literal(value, depth + 1)).collect();
            all.map(Literal::Sequence)
        }
        _ => Err(wrong()),
    }
}
