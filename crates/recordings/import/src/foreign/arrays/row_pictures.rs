//! Pictures of rows, stored in one array per group.

use std::sync::Arc;

use super::ArrayRows;
use super::frames::ArrayPictures;
use crate::foreign::columns::ColumnSource as _;
use crate::frame_names::{FrameNames, OWN_ROW};
use taceva_dataset::internal::listed;

impl ArrayRows {
    /// Opens the pictures that `names` describes, group after group.
    pub(super) fn pictures_of_rows(&self, names: &FrameNames) -> Result<ArrayPictures, String> {
        if let FrameNames::Array(array) = names
            && self.groups.len() > 1
            && !["row", OWN_ROW].contains(&array.index.as_str())
        {
            return Err(format!(
                "`index = \"{}\"` does not name one of the {} groups. Leave out `index`: a row of a group has the picture at its own \
                 position",
                array.index,
                self.groups.len()
            ));
        }
        let name = match names {
            FrameNames::Array(array) => array.path.as_deref().unwrap_or("value"),
            FrameNames::Bytes(column) => column,
            _ => return Err("frames that are neither arrays nor bytes".to_owned()),
        };
        let parts: Result<Vec<String>, String> = self
            .groups
            .iter()
            .map(|group| {
                let found = self.info(group, name);
                let pictures = found.as_ref().map_or(0, |(_, info)| info.rows());
                // Otherwise the pictures of later groups would be assigned to wrong rows.
                if self.groups.len() > 1 && found.is_some() && pictures != group.rows as u64 {
                    return Err(format!(
                        "`{name}` of {} has {pictures} pictures for {} rows",
                        group.path, group.rows
                    ));
                }
                found.map(|(path, _)| path).ok_or_else(|| {
                    self.why_absent(name).unwrap_or_else(|| {
                        format!(
                            "no array `{name}` of frames in {}; available: {}",
                            match group.path.as_str() {
                                "" => "it",
                                path => path,
                            },
                            listed(&self.names())
                        )
                    })
                })
            })
            .collect();
        ArrayPictures::new(&self.path, Arc::clone(&self.file), parts?, names)
    }
}
