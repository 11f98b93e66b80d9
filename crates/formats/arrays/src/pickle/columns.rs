//! Columns of a pickle: an array, a list of numbers, or one column for each key of a dictionary or of a list of dictionaries.

use std::sync::Arc;

use super::value::{Bytes, Content, Id, PickledArray, Value};
use crate::element::Element;
use crate::error::Problem;
use crate::limits;
use crate::scalar::shown;

#[derive(Debug)]
pub(crate) struct Column {
    pub(crate) name: String,
    pub(crate) shape: Vec<u64>,
    pub(crate) cells: Cells,
}

/// Elements of a column.
#[derive(Debug)]
pub(crate) enum Cells {
    /// One array.
    Array(PickledArray),
    /// Consecutive arrays of the same shape and type.
    Arrays(Vec<PickledArray>),
    /// Values that are not in an array, by their ids.
    Plain { element: Element, ids: Vec<Id> },
}

/// Values of a pickle, and a limit on the number of visits to them.
pub(crate) struct Values<'a> {
    pub(crate) values: &'a [Value],
    /// Remaining number of visits to values. Lists that contain the same list several times could otherwise need exponentially many visits.
    left: u64,
    text: &'a dyn Fn(&Bytes) -> Option<String>,
}

/// Columns of a pickle, and the values that are not columns, each with the reason.
pub(crate) type Found = (Vec<Column>, Vec<(String, Problem)>);

impl<'a> Values<'a> {
    pub(crate) fn new(
        values: &'a [Value],
        text: &'a dyn Fn(&Bytes) -> Option<String>,
    ) -> Values<'a> {
        Values {
            values,
            left: 4 * limits::PICKLED_VALUES,
            text,
        }
    }

    fn value(&self, id: Id) -> &'a Value {
        &self.values[id as usize]
    }

    /// Columns of the whole pickle.
    pub(crate) fn columns(&mut self, whole: Id) -> Result<Found, Problem> {
        let mut found = (Vec::new(), Vec::new());
        self.named(whole, "", 0, &mut found)?;
        Ok(found)
    }

    fn named(
        &mut self,
        id: Id,
        name: &str,
        depth: usize,
        found: &mut Found,
    ) -> Result<(), Problem> {
        if depth > limits::LITERAL_DEPTH {
            return Err(Problem::too_large(
                "dictionaries within dictionaries",
                depth as u64,
                limits::LITERAL_DEPTH as u64,
            ));
        }
        let full = |key: &str| {
            if name.is_empty() {
                key.to_owned()
            } else {
                format!("{name}.{key}")
            }
        };
        match self.value(id) {
            Value::Dictionary(entries) => {
                for (key, value) in self.entries(entries)? {
                    self.named(value, &full(&key), depth + 1, found)?;
                }
            }
            Value::Array(PickledArray {
                shape,
                content: Content::Objects(list),
                ..
            }) => {
                let single = match self.value(*list) {
                    Value::List(values) if shape.is_empty() => values.first().copied(),
                    _ => None,
                };
                self.named(single.unwrap_or(*list), name, depth + 1, found)?;
            }
            Value::List(rows) | Value::Tuple(rows) if self.is_table(rows) => {
                self.table(rows, name, found)?
            }
            _ => self.column(id, if name.is_empty() { "value" } else { name }, found)?,
        }
        if found.0.len() as u64 > limits::ARRAYS {
            return Err(Problem::too_large(
                "columns",
                found.0.len() as u64,
                limits::ARRAYS,
            ));
        }
        Ok(())
    }

    fn column(&mut self, id: Id, name: &str, found: &mut Found) -> Result<(), Problem> {
        match self.cells(id) {
            Ok((shape, cells)) => found.0.push(Column {
                name: name.to_owned(),
                shape,
                cells,
            }),
            Err(reason @ Problem::Unsupported { .. }) => found.1.push((name.to_owned(), reason)),
            Err(problem) => return Err(problem),
        }
        Ok(())
    }

    /// Value of each key, in the order of first occurrence. Of several entries with the same key, the last is used.
    fn entries(&mut self, entries: &[(Id, Id)]) -> Result<Vec<(String, Id)>, Problem> {
        let mut named: Vec<(String, Id)> = Vec::new();
        let mut places = std::collections::BTreeMap::new();
        for (key, value) in entries {
            self.look()?;
            let key = match self.value(*key) {
                Value::Text(text) => (self.text)(text),
                Value::Whole(number) => Some(number.to_string()),
                _ => None,
            };
            // Only texts and whole numbers can be requested as keys.
            let Some(key) = key else { continue };
            match places.get(&key) {
                Some(place) => named[*place] = (key, *value),
                None => {
                    places.insert(key.clone(), named.len());
                    named.push((key, *value));
                }
            }
        }
        Ok(named)
    }

    fn look(&mut self) -> Result<(), Problem> {
        self.look_at(1)
    }

    fn look_at(&mut self, count: usize) -> Result<(), Problem> {
        self.left = self.left.checked_sub(count as u64).ok_or_else(|| {
            Problem::too_large(
                "values of the pickle, with repeated references counted each time",
                4 * limits::PICKLED_VALUES + 1,
                4 * limits::PICKLED_VALUES,
            )
        })?;
        Ok(())
    }

    fn is_table(&self, rows: &[Id]) -> bool {
        !rows.is_empty()
            && rows
                .iter()
                .all(|row| matches!(self.value(*row), Value::Dictionary(_)))
    }

    /// Adds one column for each key of the first dictionary in a list. All dictionaries of the list must have the key.
    fn table(&mut self, rows: &[Id], name: &str, found: &mut Found) -> Result<(), Problem> {
        let mut columns: Vec<(String, Vec<Id>)> = Vec::new();
        for (row, id) in rows.iter().enumerate() {
            let Value::Dictionary(entries) = self.value(*id) else {
                continue;
            };
            let named = self.entries(entries)?;
            if row == 0 {
                columns = named
                    .into_iter()
                    .map(|(key, value)| (key, vec![value]))
                    .collect();
                continue;
            }
            let named: std::collections::BTreeMap<String, Id> = named.into_iter().collect();
            for (key, values) in &mut columns {
                values.extend(named.get(key));
            }
        }
        for (key, values) in columns {
            let full = if name.is_empty() {
                key.clone()
            } else {
                format!("{name}.{key}")
            };
            if values.len() < rows.len() {
                found.1.push((
                    full,
                    Problem::unsupported(
                        format!(
                            "`{}` is in only {} of {} dictionaries",
                            shown(&key),
                            values.len(),
                            rows.len()
                        ),
                        "write it in every dictionary",
                    ),
                ));
                continue;
            }
            match self.list(&values) {
                Ok((shape, cells)) => found.0.push(Column {
                    name: full,
                    shape,
                    cells,
                }),
                Err(reason @ Problem::Unsupported { .. }) => found.1.push((full, reason)),
                Err(problem) => return Err(problem),
            }
        }
        Ok(())
    }

    fn cells(&mut self, id: Id) -> Result<(Vec<u64>, Cells), Problem> {
        match self.value(id) {
            Value::Array(array) => match &array.content {
                Content::Numbers { .. } => Ok((array.shape.clone(), Cells::Array(array.clone()))),
                Content::Objects(list) => self.cells(*list),
                Content::Nothing => Err(Problem::unsupported(
                    "an array without content",
                    "write it again",
                )),
            },
            Value::List(values) | Value::Tuple(values) => self.list(values),
            _ => {
                let element = self.element(&[id])?;
                Ok((
                    Vec::new(),
                    Cells::Plain {
                        element,
                        ids: vec![id],
                    },
                ))
            }
        }
    }

    /// Shape and cells of the list `values`. All values are of one kind, or lists of equal length of such values.
    fn list(&mut self, values: &[Id]) -> Result<(Vec<u64>, Cells), Problem> {
        self.look_at(values.len())?;
        let arrays = values.iter().map_while(|id| match self.value(*id) {
            Value::Array(array) if matches!(array.content, Content::Numbers { .. }) => Some(array),
            _ => None,
        });
        let arrays: Vec<PickledArray> = arrays.cloned().collect();
        if let (Some(first), true) = (arrays.first(), arrays.len() == values.len()) {
            let item_of = |array: &PickledArray| match &array.content {
                Content::Numbers { item, .. } => Some(item.clone()),
                _ => None,
            };
            let is_alike = arrays
                .iter()
                .all(|array| array.shape == first.shape && item_of(array) == item_of(first));
            if !is_alike {
                return Err(Problem::unsupported(
                    "arrays of different shapes or types in one list",
                    "write arrays of one shape, or each under a separate key",
                ));
            }
            let shape = [&[values.len() as u64], first.shape.as_slice()].concat();
            return Ok((shape, Cells::Arrays(arrays)));
        }
        let mut shape = vec![values.len() as u64];
        let mut ids = values.to_vec();
        // Lists of lists: each axis is the common length of all lists at that depth.
        while let Some(length) = ids.first().and_then(|id| self.length(*id)) {
            if shape.len() == limits::AXES {
                return Err(Problem::unsupported(
                    "lists that are nested too deeply",
                    "write an array",
                ));
            }
            let mut inner = Vec::new();
            for id in &ids {
                self.look()?;
                match self.value(*id) {
                    Value::List(values) | Value::Tuple(values) if values.len() == length => {
                        self.look_at(values.len())?;
                        inner.extend_from_slice(values);
                    }
                    _ => {
                        return Err(Problem::unsupported(
                            "lists of different lengths in one list",
                            "write lists of one length, or an array",
                        ));
                    }
                }
            }
            shape.push(length as u64);
            ids = inner;
        }
        let element = self.element(&ids)?;
        Ok((shape, Cells::Plain { element, ids }))
    }

    fn length(&self, id: Id) -> Option<usize> {
        match self.value(id) {
            Value::List(values) | Value::Tuple(values) => Some(values.len()),
            _ => None,
        }
    }

    /// Common type of the values. Whole numbers mixed with floating-point numbers become floating point.
    fn element(&self, ids: &[Id]) -> Result<Element, Problem> {
        let mut common = None;
        for id in ids {
            let element = match self.value(*id) {
                Value::Bool(_) => Element::Bool,
                Value::Whole(_) => Element::Signed(64),
                Value::Float(_) => Element::Float(64),
                Value::Text(_) => Element::Text,
                Value::Bytes(_) => Element::Bytes,
                _ => {
                    return Err(Problem::unsupported(
                        "values other than numbers, strings or bytes",
                        "write numbers, strings, bytes or arrays",
                    ));
                }
            };
            common = match (common, element) {
                (None, element) => Some(element),
                (Some(common), element) if common == element => Some(element),
                (Some(Element::Signed(_)), Element::Float(_))
                | (Some(Element::Float(_)), Element::Signed(_)) => Some(Element::Float(64)),
                _ => {
                    return Err(Problem::unsupported(
                        "values of different kinds in one list",
                        "write values of one kind",
                    ));
                }
            };
        }
        Ok(common.unwrap_or(Element::Float(64)))
    }
}

/// Bytes that are in memory; `None` for bytes in the file.
pub(crate) fn held(bytes: &Bytes) -> Option<Arc<Vec<u8>>> {
    match bytes {
        Bytes::Held(bytes) => Some(Arc::clone(bytes)),
        Bytes::InFile { .. } => None,
    }
}
