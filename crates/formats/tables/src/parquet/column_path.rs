//! Selection of columns by names such as `pose.x` or `ft[2]`, in the schema and within cells.

use super::kind::ColumnKind;
use super::schema::{LeafForm, Node, NodeKind};
use crate::cell::Cell;
use crate::error::TableError;
use crate::path::{indices, longest};
use crate::source::Source;

/// Column, and the requested path in its cells.
pub(crate) struct Found {
    column: Node,
    name: String,
    rest: String,
}

impl Found {
    /// Finds the column whose name `name` begins with. Of its structures, only the members that `name` selects are kept.
    pub(crate) fn new(source: &Source, columns: &[Node], name: &str) -> Result<Found, TableError> {
        let top = longest(name, columns.iter().map(|node| node.name.as_str()));
        let found = top.and_then(|(at, rest)| Some((narrow(&columns[at], rest)?, rest)));
        match found {
            Some((column, rest)) => Ok(Found {
                column,
                name: name.to_owned(),
                rest: rest.to_owned(),
            }),
            None => Err(source.missing(name, names(columns))),
        }
    }

    pub(crate) fn column(&self) -> &Node {
        &self.column
    }

    /// Kind of the requested part of the cells.
    pub(crate) fn kind(&self) -> Option<ColumnKind> {
        inside(&self.column, &self.rest).map(ColumnKind::of)
    }

    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// Index of the requested leaf, if it has no logical type and the path has no list.
    pub(crate) fn leaf_of_bytes(&self) -> Option<usize> {
        leaf_of_bytes(&self.column, &self.rest)
    }

    /// Requested part of `cell`; [`Cell::Null`] if a structure or a list on the path is null.
    pub(crate) fn inside(
        &self,
        source: &Source,
        row: usize,
        cell: Cell,
    ) -> Result<Cell, TableError> {
        if self.rest.is_empty() {
            return Ok(cell);
        }
        cell.into_inside(&self.rest).ok_or_else(|| {
            source.mismatch(
                &self.name,
                format!("row {row} (from 0) has no such element"),
            )
        })
    }
}

/// Index of the leaf at the path `rest` inside `node`, if the path has no list and the leaf no logical type.
fn leaf_of_bytes(node: &Node, rest: &str) -> Option<usize> {
    match &node.kind {
        NodeKind::Leaf {
            column,
            form: LeafForm::Plain,
            ..
        } => Some(*column),
        NodeKind::Struct(members) if !rest.is_empty() => {
            let names = members.iter().map(|member| member.name.as_str());
            let (member, rest) = longest(rest, names)?;
            leaf_of_bytes(&members[member], rest)
        }
        NodeKind::Struct(_) | NodeKind::Leaf { .. } | NodeKind::List { .. } => None,
    }
}

/// Part of `node` at the path `rest`; `None` if it does not exist.
fn inside<'n>(node: &'n Node, rest: &str) -> Option<&'n Node> {
    let mut node = node;
    let mut rest = rest;
    while !rest.is_empty() {
        match &node.kind {
            NodeKind::Leaf { .. } => return None,
            NodeKind::Struct(members) => {
                let names = members.iter().map(|member| member.name.as_str());
                let (member, left) = longest(rest, names)?;
                (node, rest) = (&members[member], left);
            }
            NodeKind::List { .. } => {
                let (numbers, left) = indices(rest)?;
                for _ in numbers {
                    let NodeKind::List { element, .. } = &node.kind else {
                        return None;
                    };
                    node = element;
                }
                rest = left;
            }
        }
    }
    Some(node)
}

/// Copy of `node` with only the members on the path `rest`; `None` if there are none.
fn narrow(node: &Node, rest: &str) -> Option<Node> {
    if rest.is_empty() {
        return Some(node.clone());
    }
    let kind = match &node.kind {
        NodeKind::Leaf { .. } => return None,
        NodeKind::Struct(members) => {
            let (at, left) = longest(rest, members.iter().map(|member| member.name.as_str()))?;
            NodeKind::Struct(vec![narrow(&members[at], left)?])
        }
        NodeKind::List {
            definition,
            repetition,
            element,
        } => {
            let (numbers, left) = indices(rest)?;
            let mut inner = element.as_ref();
            for _ in &numbers[1..] {
                let NodeKind::List { element, .. } = &inner.kind else {
                    return None;
                };
                inner = element;
            }
            let element = match numbers.len() {
                1 => narrow(element, left)?,
                _ => {
                    narrow(inner, left)?;
                    element.as_ref().clone()
                }
            };
            NodeKind::List {
                definition: *definition,
                repetition: *repetition,
                element: Box::new(element),
            }
        }
    };
    Some(Node {
        kind,
        ..node.clone()
    })
}

/// Names of all columns. The list has the members of a structure, and not the structure.
pub(crate) fn names(columns: &[Node]) -> Vec<String> {
    let mut names = Vec::new();
    for node in columns {
        add_names(node, &node.name, &mut names);
    }
    names
}

fn add_names(node: &Node, name: &str, into: &mut Vec<String>) {
    match &node.kind {
        NodeKind::Struct(members) => {
            for member in members {
                add_names(member, &format!("{name}.{}", member.name), into);
            }
        }
        NodeKind::Leaf { .. } | NodeKind::List { .. } => into.push(name.to_owned()),
    }
}
