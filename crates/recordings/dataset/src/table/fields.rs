//! Fields of selected rows as columns for metrics.

use taceva_core::{Column, Field, FieldSet, Labels, Nanometre};

use super::Table;

impl Table {
    /// Fields that at least one row has.
    pub fn fields(&self) -> FieldSet {
        let carried = [
            (Field::Frame, self.frames.iter().any(Option::is_some)),
            (Field::Truth, !self.channels.is_empty() && self.rows() > 0),
            (Field::Point, self.point_id.iter().any(Option::is_some)),
            (
                Field::DepthStep,
                self.depth_step.iter().any(Option::is_some),
            ),
            (Field::Repeat, self.repeat.iter().any(Option::is_some)),
            (Field::Phase, self.phase.iter().any(Option::is_some)),
            (Field::Scene, self.scene.iter().any(Option::is_some)),
            (Field::UnitId, self.unit_id.iter().any(Option::is_some)),
            (Field::Stamp, self.t_s.iter().any(Option::is_some)),
            (Field::Kind, self.kind.iter().any(Option::is_some)),
            (Field::Spacing, self.spacing.iter().any(Option::is_some)),
            (Field::Intensity, self.intensity.iter().any(Option::is_some)),
            (Field::FrameDigest, self.frames.iter().any(Option::is_some)),
        ];
        carried
            .into_iter()
            .filter_map(|(field, is_carried)| is_carried.then_some(field))
            .collect()
    }

    /// Texts of `field` in `rows`, in order: contact point, unit, scene, phase, kind of grating or digest of the frame. `None` if the field has no text.
    ///
    /// # Panics
    /// Panics if the row does not exist.
    pub fn labels(&self, field: Field, rows: impl Iterator<Item = usize>) -> Option<Labels> {
        let mut labels = Labels::default();
        let mut push = |name: Option<&str>| match name {
            Some(name) => labels.push(name),
            None => labels.push_absent(),
        };
        match field {
            Field::Point => rows.for_each(|row| push(self.point_id[row].as_deref())),
            Field::UnitId => rows.for_each(|row| push(self.unit_id[row].as_deref())),
            Field::Scene => rows.for_each(|row| push(self.scene[row].as_deref())),
            Field::Phase => rows.for_each(|row| push(self.phase[row].map(|phase| phase.name()))),
            Field::Kind => rows.for_each(|row| push(self.kind[row].map(|kind| kind.name()))),
            Field::FrameDigest => rows.for_each(|row| {
                let digest = self.frames[row]
                    .as_ref()
                    .map(|frame| frame.digest.to_string());
                push(digest.as_deref());
            }),
            _ => return None,
        }
        Some(labels)
    }

    /// Numbers of `field` in `rows`, in order: depth step, repeat, time in s, spacing in whole nm, intensity. `None` if the field is not numeric.
    ///
    /// # Panics
    /// Panics if the row does not exist.
    pub fn numbers(&self, field: Field, rows: impl Iterator<Item = usize>) -> Option<Column> {
        let mut column = Column::default();
        match field {
            Field::DepthStep => {
                rows.for_each(|row| column.push(self.depth_step[row].map(f64::from)))
            }
            Field::Repeat => rows.for_each(|row| column.push(self.repeat[row].map(f64::from))),
            Field::Stamp => rows.for_each(|row| column.push(self.t_s[row])),
            Field::Spacing => {
                rows.for_each(|row| column.push(self.spacing[row].map(Nanometre::to_f64)))
            }
            Field::Intensity => rows.for_each(|row| column.push(self.intensity[row])),
            _ => return None,
        }
        Some(column)
    }
}
