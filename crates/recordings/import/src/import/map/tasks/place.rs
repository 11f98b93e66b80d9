//! Tasks of places: positions without an orientation.

use super::{Check, ColumnName, TaskMap, WrittenFrom, WrittenTask};
use taceva_dataset::{DatasetError, Task};

impl Check<'_> {
    pub(super) fn place(
        &self,
        mut task: Task,
        written: WrittenTask,
        offset: usize,
    ) -> Result<TaskMap, DatasetError> {
        let is_other = written.names.is_some()
            || written.positive.is_some()
            || written.over.is_some()
            || written.thresholds.is_some();
        let columns = match written.from {
            Some(WrittenFrom::Place(columns)) if !is_other => columns.t,
            _ => {
                let problem = "a place needs `from = { t = [\"x\", \"y\", \"z\"] }`; remove `names`, `positive`, `over` and `thresholds`";
                return Err(self.at(offset, problem));
            }
        };
        let units = self.units_of_positions(written.unit.as_ref(), &task.name, offset)?;
        task.from = columns.into_iter().map(ColumnName::into_name).collect();
        task.frame = written.frame;
        Ok(TaskMap {
            task,
            units,
            array: None,
        })
    }
}
