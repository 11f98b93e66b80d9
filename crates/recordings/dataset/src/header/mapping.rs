//! Mappings of the imports of a dataset, and conflicts with another import map.

use super::class_mapping::MappedClass;
use super::column_mapping::{MappedColumn, misread};
use super::join_mapping::MappedJoin;
use super::map_conflict::{Misread, differing};
use super::picture_mapping::MappedPictures;

/// Settings that determine the values that an import reads from cells, rows and arrays of the source folder.
#[derive(Clone, Debug, Default, PartialEq)]
#[doc(hidden)]
pub struct Mapping {
    /// Mappings of the labels.
    pub columns: Vec<MappedColumn>,
    /// Mappings of the joined tables.
    pub joins: Vec<MappedJoin>,
    /// Mappings of the pictures.
    pub pictures: Vec<MappedPictures>,
    /// Mappings of the classes.
    pub classes: Vec<MappedClass>,
    /// Channels that together form one rotation.
    pub rotations: Vec<Vec<String>>,
}

/// Remedy for a join that an earlier import mapped differently.
const OTHER_JOIN: &str =
    "if that table was recorded differently this time, give the join another name in the map";
/// Remedy for a list of classes that became longer.
const LONGER_LIST: &str = "keep the list as it was, and add new names at its end";
/// Remedy for an array that an earlier import mapped differently.
const OTHER_ARRAY: &str =
    "if the pictures were written differently this time, give their array another name";

impl Mapping {
    /// True if no import map is stored, because the dataset was recorded and not imported.
    pub fn is_empty(&self) -> bool {
        *self == Mapping::default()
    }

    /// First key of the new import map `new` that contradicts `self`. Entries with other names are ignored.
    pub fn misread(&self, new: &Mapping) -> Option<Misread> {
        let columns = misread(&self.columns, &new.columns);
        let joins = new.joins.iter().find_map(|join| {
            let mut known = self.joins.iter().filter(|known| known.name == join.name);
            if known.clone().any(|known| known == join) {
                return None;
            }
            differing(known.next()?.facts(), join.facts(), OTHER_JOIN)
        });
        let pictures = new.pictures.iter().find_map(|pictures| {
            let mut known = self.pictures.iter().filter(|known| pictures.is_of(known));
            differing(known.next()?.facts(), pictures.facts(), OTHER_ARRAY)
        });
        let classes = new.classes.iter().find_map(|class| {
            let mut known = self.classes.iter();
            let known = known.find(|known| known.name == class.name && known.from == class.from)?;
            let at = class.other_position(known)?;
            Some(Misread {
                key: format!("classes.{}.names[{at}]", class.name),
                own: format!("`{}`", known.names[at]),
                other: format!("`{}`", class.names[at]),
                mend: LONGER_LIST,
            })
        });
        columns.or(joins).or(pictures).or(classes)
    }

    /// Combined mapping after rows were added with the map `new`.
    pub fn and(self, new: &Mapping) -> Mapping {
        Mapping {
            columns: united(self.columns, &new.columns),
            joins: united(self.joins, &new.joins),
            pictures: united(self.pictures, &new.pictures),
            classes: united(self.classes, &new.classes),
            rotations: united(self.rotations, &new.rotations),
        }
    }
}

/// `known`, followed by the entries of `new` that it lacks.
fn united<T: Clone + PartialEq>(mut known: Vec<T>, new: &[T]) -> Vec<T> {
    for one in new {
        if !known.contains(one) {
            known.push(one.clone());
        }
    }
    known
}
