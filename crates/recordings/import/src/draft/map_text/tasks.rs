//! Suggestions of tasks in a draft, for columns whose names contain the word `slip`.

use crate::draft::roles::words;

/// Comment that shows how the first column whose name contains `slip` becomes a task; `None` without such a column.
pub(super) fn suggestion<'n>(names: impl Iterator<Item = &'n str>) -> Option<String> {
    let mut names = names.filter(|name| words(name).iter().any(|word| word == "slip"));
    let name = names.next()?;
    Some(format!(
        "\n# {name:?} can be a task: [task.slip] with kind = \"event\", from = {name:?}, names = [\"no_slip\", \"slip\"], positive = \"slip\",\n\
         # and cluster = the id or attribute that names the trajectory."
    ))
}
