//! Features of a dataset to be written.

use serde_json::{Value, json};

use crate::parquet::{WrittenColumn, WrittenKind};

/// Feature of a dataset to be written.
///
/// ```
/// use taceva_tables::{WrittenColumn, WrittenFeature, WrittenKind};
/// let state = WrittenColumn::new("observation.state", WrittenKind::Numbers(Some(2)));
/// let feature = WrittenFeature::new(state, [2]).with_names(["Fx", "Fz"]).with_unit("N");
/// assert_eq!(feature.names.as_deref(), Some(&["Fx".to_owned(), "Fz".to_owned()][..]));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct WrittenFeature {
    /// Name and kind of the cells. The name contains no `/`.
    pub column: WrittenColumn,
    /// Shape of the feature in one row. For a picture: height, width and colours.
    pub shape: Vec<u64>,
    /// Names of the elements, or of the axes of a picture; `None` without names.
    pub names: Option<Vec<String>>,
    /// Unit of the numbers, or several units in the order of `names`; `None` without a unit. LeRobot ignores this key.
    pub unit: Option<String>,
}

impl WrittenFeature {
    /// Creates a feature of this shape with unnamed elements. A list of one number is written as a number, as LeRobot expects.
    pub fn new(column: WrittenColumn, shape: impl IntoIterator<Item = u64>) -> WrittenFeature {
        WrittenFeature {
            column,
            shape: shape.into_iter().collect(),
            names: None,
            unit: None,
        }
    }

    /// Sets the names of the elements, or of the axes of a picture.
    #[must_use]
    pub fn with_names<N: Into<String>>(self, names: impl IntoIterator<Item = N>) -> WrittenFeature {
        WrittenFeature {
            names: Some(names.into_iter().map(Into::into).collect()),
            ..self
        }
    }

    /// Sets the unit of the numbers.
    #[must_use]
    pub fn with_unit(self, unit: impl Into<String>) -> WrittenFeature {
        WrittenFeature {
            unit: Some(unit.into()),
            ..self
        }
    }

    fn dtype(&self) -> &'static str {
        match self.column.kind {
            WrittenKind::Integer => "int64",
            WrittenKind::Number | WrittenKind::Numbers(_) => "float64",
            WrittenKind::Single | WrittenKind::Singles(_) => "float32",
            WrittenKind::Text | WrittenKind::Texts => "string",
            WrittenKind::Picture => "image",
        }
    }

    pub(super) fn json(&self) -> Value {
        let mut feature =
            json!({ "dtype": self.dtype(), "shape": self.shape, "names": self.names });
        if let Some(unit) = &self.unit {
            feature["unit"] = unit.as_str().into();
        }
        feature
    }
}
