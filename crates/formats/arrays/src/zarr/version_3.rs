//! Metadata of zarr version 3: `zarr.json`.

use serde_json::Value;

use super::array::{ZarrArray, lengths};
use super::codecs::Codec;
use super::fill::fill;
use crate::error::Problem;
use crate::fields::Item;
use crate::scalar::{Filler, Kind, Scalar};

pub(crate) fn array(metadata: &Value) -> Result<ZarrArray, Problem> {
    if metadata["zarr_format"] != 3 {
        return Err(Problem::damaged(
            0,
            format!("`zarr_format`: {}", metadata["zarr_format"]),
            "3",
        ));
    }
    if metadata["chunk_grid"]["name"] != "regular" {
        return Err(Problem::unsupported(
            format!("chunks of a grid {}", metadata["chunk_grid"]["name"]),
            "write it in regular chunks",
        ));
    }
    let chunk = lengths(
        &metadata["chunk_grid"]["configuration"]["chunk_shape"],
        "chunk_shape",
    )?;
    let (mut codecs, mut is_big_endian) = (Vec::new(), false);
    let listed = metadata["codecs"].as_array();
    for codec in listed.ok_or_else(|| Problem::damaged(0, "no `codecs`", "a list of codecs"))? {
        let configuration = &codec["configuration"];
        match codec["name"].as_str().unwrap_or("?") {
            "bytes" => is_big_endian = configuration["endian"] == "big",
            "transpose" => {
                let order = configuration["order"].as_array();
                let order = order.and_then(|order| {
                    order
                        .iter()
                        .map(|axis| usize::try_from(axis.as_u64()?).ok())
                        .collect::<Option<Vec<usize>>>()
                });
                let is_order = |order: &Vec<usize>| {
                    (0..chunk.len()).all(|axis| order.contains(&axis)) && order.len() == chunk.len()
                };
                let order = order.filter(is_order);
                codecs.push(Codec::Transposed(order.ok_or_else(|| {
                    Problem::damaged(
                        0,
                        format!("`order`: {}", configuration["order"]),
                        "every axis once",
                    )
                })?));
            }
            "sharding_indexed" => {
                return Err(Problem::unsupported(
                    "chunks in shards",
                    "write it without `shards`",
                ));
            }
            name => codecs.push(Codec::from_name(name)?),
        }
    }
    let item = Item::plain(scalar(&metadata["data_type"], is_big_endian)?);
    let encoding = &metadata["chunk_key_encoding"];
    let separator = encoding["configuration"]["separator"].as_str();
    let (prefix, separator) = match encoding["name"].as_str() {
        Some("default") => ("c", separator.unwrap_or("/")),
        Some("v2") => ("", separator.unwrap_or(".")),
        _ => {
            return Err(Problem::unsupported(
                format!("chunk names by {}", encoding["name"]),
                "write it with the default names",
            ));
        }
    };
    ZarrArray {
        name: String::new(),
        shape: lengths(&metadata["shape"], "shape")?,
        chunk,
        fill: fill(&metadata["fill_value"], &item),
        item,
        codecs,
        prefix,
        separator: if separator == "/" { '/' } else { '.' },
    }
    .check()
}

fn scalar(data_type: &Value, is_big_endian: bool) -> Result<Scalar, Problem> {
    let name = data_type
        .as_str()
        .or_else(|| data_type["name"].as_str())
        .unwrap_or("?");
    let length = data_type["configuration"]["length_bytes"].as_u64();
    let length = length.and_then(|length| usize::try_from(length).ok());
    let (kind, bytes) = match name {
        "bool" => (Kind::Bool, Some(1)),
        "fixed_length_utf32" => (Kind::WideText, length),
        "null_terminated_bytes" => (Kind::Text(Filler::Zeros), length),
        name => {
            let digits = name.trim_start_matches(|letter: char| letter.is_ascii_alphabetic());
            let kind = match &name[..name.len() - digits.len()] {
                "uint" => Kind::Unsigned,
                "int" => Kind::Signed,
                "float" => Kind::Float,
                _ => {
                    return Err(Problem::unsupported(
                        format!("elements of type {data_type}"),
                        "write numbers of 8 to 64 bits, or strings of fixed length",
                    ));
                }
            };
            (
                kind,
                digits
                    .parse::<usize>()
                    .ok()
                    .filter(|bits| bits % 8 == 0)
                    .map(|bits| bits / 8),
            )
        }
    };
    bytes
        .and_then(|bytes| Scalar::new(kind, bytes, is_big_endian))
        .ok_or_else(|| {
            Problem::unsupported(
                format!("elements of type {data_type}"),
                "write numbers of 8 to 64 bits, or strings of fixed length",
            )
        })
}
