//! Metadata of a folder of a zarr store, version 2 or 3.

use serde_json::Value;

use super::array::ZarrArray;
use super::tree::Tree;
use super::{version_2, version_3};
use crate::error::Problem;
use crate::limits;

/// Metadata of one folder of a zarr store.
#[derive(Debug, Default)]
pub(crate) struct Node {
    pub(crate) is_group: bool,
    pub(crate) array: Option<Result<ZarrArray, Problem>>,
    pub(crate) attributes: Option<Value>,
}

pub(crate) fn node(folder: &Tree) -> Result<Node, Problem> {
    if let Some(metadata) = json(folder, "zarr.json")? {
        let is_group = metadata["node_type"] == "group";
        let array = (metadata["node_type"] == "array").then(|| version_3::array(&metadata));
        return Ok(Node {
            is_group,
            array,
            attributes: metadata.get("attributes").cloned(),
        });
    }
    let attributes = json(folder, ".zattrs")?;
    if let Some(metadata) = json(folder, ".zarray")? {
        return Ok(Node {
            array: Some(version_2::array(&metadata)),
            attributes,
            ..Node::default()
        });
    }
    let is_group = json(folder, ".zgroup")?.is_some();
    Ok(Node {
        is_group,
        attributes,
        ..Node::default()
    })
}

fn json(folder: &Tree, name: &str) -> Result<Option<Value>, Problem> {
    let what = format!("bytes of `{name}`");
    let Some(text) = folder.bytes(name, &what, limits::METADATA_BYTES)? else {
        return Ok(None);
    };
    let value = serde_json::from_slice(&text);
    value.map(Some).map_err(|error| {
        Problem::damaged(
            0,
            format!("`{name}`, line {}: {error}", error.line()),
            "JSON",
        )
    })
}
