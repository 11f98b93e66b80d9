//! Labels of a row: numbers in the stored units, and texts of closed lists.

use taceva_core::{GratingKind, Limit, Nanometre, Phase, is_scorable};

use super::MappedTable;
use crate::error::ImportError;
use crate::import::map::{ClassMap, ColumnMap};
use crate::import::resolve::ClassCells;

impl MappedTable<'_> {
    /// Numbers of a row, one per channel, without the weight of a tool and before the zero is subtracted.
    pub(super) fn measured(&self, row: usize) -> Result<Vec<Option<f64>>, ImportError> {
        let mut labels = self.converted(row)?;
        if let Some(gravity) = &self.map.gravity {
            self.take_weight(row, gravity, &mut labels)?;
        }
        for (label, map) in labels.iter_mut().zip(&self.map.columns) {
            // Subtracts from zero, so that negating 0 gives no −0.
            if map.is_negated {
                *label = label.map(|number| 0.0 - number);
            }
        }
        Ok(labels)
    }

    /// Numbers of a row, one per channel, in the stored units, with the signs of the table.
    fn converted(&self, row: usize) -> Result<Vec<Option<f64>>, ImportError> {
        self.truth
            .iter()
            .zip(&self.map.columns)
            .map(|(column, map)| match map.is_moved() {
                false => self.table.number_in_unit(row, *column, &map.unit),
                true => self.moved(row, *column, map),
            })
            .collect()
    }

    /// Number in a cell with offset, scale and unit conversion applied.
    pub(super) fn moved(
        &self,
        row: usize,
        column: usize,
        map: &ColumnMap,
    ) -> Result<Option<f64>, ImportError> {
        let Some(number) = self.table.number(row, column)? else {
            return Ok(None);
        };
        let scaled = map.scale.unwrap_or(1.0) * (number - map.offset.unwrap_or(0.0));
        let moved = map.unit.convert(scaled);
        match is_scorable(moved) {
            true => Ok(Some(moved)),
            false => Err(self.wrong(row, column, "too large for its unit")),
        }
    }

    pub(super) fn time(&self, row: usize) -> Result<Option<f64>, ImportError> {
        match (self.time, &self.map.time) {
            (Some(column), Some(map)) => self.table.number_in_unit(row, column, &map.unit),
            _ => Ok(None),
        }
    }

    pub(super) fn phase(&self, row: usize) -> Result<Option<Phase>, ImportError> {
        self.value(row, self.phase, Phase::from_name, || {
            "expected `load` or `unload`".to_owned()
        })
    }

    pub(super) fn limited_by(&self, row: usize) -> Result<Option<Limit>, ImportError> {
        self.value(row, self.limited_by, Limit::from_name, || {
            let known = Limit::ALL.map(Limit::name).join("`, `");
            format!("expected one of `{known}`")
        })
    }

    pub(super) fn zero_u_mm(&self, row: usize) -> Result<Option<f64>, ImportError> {
        match self.zero_u_mm {
            Some(column) => self.table.number(row, column),
            None => Ok(None),
        }
    }

    pub(super) fn kind(&self, row: usize) -> Result<Option<GratingKind>, ImportError> {
        self.value(row, self.kind, GratingKind::from_name, || {
            "expected `line` or `dot`".to_owned()
        })
    }

    pub(super) fn spacing(&self, row: usize) -> Result<Option<Nanometre>, ImportError> {
        let positive = |text: &str| {
            let spacing = text.parse::<Nanometre>().ok();
            spacing.filter(|spacing| *spacing > Nanometre(0))
        };
        self.value(row, self.spacing, positive, || {
            "expected a spacing in mm, such as 0.35".to_owned()
        })
    }

    /// Value of a cell, parsed by `from`; `None` if the map names no column or the cell is empty. A text that `from` does not accept is an error.
    fn value<T>(
        &self,
        row: usize,
        column: Option<usize>,
        from: impl Fn(&str) -> Option<T>,
        expected: impl Fn() -> String,
    ) -> Result<Option<T>, ImportError> {
        let Some(column) = column else {
            return Ok(None);
        };
        match self.table.cell(row, column) {
            "" => Ok(None),
            text => from(text)
                .map(Some)
                .ok_or_else(|| self.wrong(row, column, &expected())),
        }
    }

    /// Attributes of a row, then its classes, as texts.
    pub(super) fn texts(&self, row: usize) -> Result<Vec<Option<String>>, ImportError> {
        let text = |column: &usize| {
            let cell = self.table.cell(row, *column);
            (!cell.is_empty()).then(|| cell.to_owned())
        };
        let mut texts: Vec<Option<String>> = self.attributes.iter().map(text).collect();
        let classes = self.map.classes.values().zip(&self.class_cells);
        for (column, (class, cells)) in self.classes.iter().zip(classes) {
            texts.push(match self.table.cell(row, *column) {
                "" => None,
                cell => Some(self.class(row, *column, cell, class, *cells)?),
            });
        }
        Ok(texts)
    }

    /// Class name for a cell that contains a name or a position.
    pub(super) fn class(
        &self,
        row: usize,
        column: usize,
        cell: &str,
        class: &ClassMap,
        cells: ClassCells,
    ) -> Result<String, ImportError> {
        let by_position = || class.names.get(class.position(cell)?);
        let by_name = || class.names.iter().find(|name| *name == cell);
        let (found, what) = match cells {
            ClassCells::Positions => (by_position(), "position in the list"),
            ClassCells::Names => (by_name(), "class of the list"),
            ClassCells::Either => (by_name().or_else(by_position), "class of the list"),
        };
        found.cloned().ok_or_else(|| {
            let known = class.names.join(", ");
            self.wrong(row, column, &format!("no {what}: {known}"))
        })
    }
}
