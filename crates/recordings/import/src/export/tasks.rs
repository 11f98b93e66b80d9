//! Writes the tasks of a dataset into the map of its export.

use std::fmt::Write as _;

use super::map::quoted;
use taceva_dataset::{Task, TaskKind};

/// Exported columns of `task`. The digests of depth maps are not exported.
pub(super) fn columns(task: &Task) -> Vec<String> {
    let mut columns = task.columns();
    if task.kind == TaskKind::Depth {
        columns.truncate(1);
    }
    columns
}

/// Section of `task` in a map. `names` maps a column name of the dataset to its name in the file.
pub(super) fn section(task: &Task, names: fn(&str) -> String) -> String {
    let columns = columns(task);
    let columns: Vec<String> = columns
        .iter()
        .map(|column| quoted(&names(column)))
        .collect();
    let mut text = format!("[task.{}]\nkind = {}", task.name, quoted(task.kind.name()));
    let mut line = |key: &str, value: &str| {
        // Writing to a string never fails.
        let _ = write!(text, "\n{key} = {value}");
    };
    match columns.as_slice() {
        [x, y, z] => {
            line("from", &format!("{{ t = [{x}, {y}, {z}] }}"));
            line("unit", "\"mm\"");
        }
        [x, y, z, quaternion @ ..] => {
            let quaternion = quaternion.join(", ");
            line(
                "from",
                &format!("{{ t = [{x}, {y}, {z}], q = [{quaternion}] }}"),
            );
            line("unit", "\"mm\"");
        }
        columns => line("from", &columns.concat()),
    }
    if !task.names.is_empty() {
        line("names", &list(&task.names));
    }
    for (key, value) in [
        ("positive", task.positive.as_ref()),
        ("cluster", Some(&task.cluster)),
        ("rule", task.rule.as_ref()),
        ("frame", task.frame.as_ref()),
    ] {
        if let Some(value) = value {
            line(key, &quoted(value));
        }
    }
    if task.is_timed {
        line("time", "true");
    }
    if let Some(maps) = &task.maps {
        line("unit", &quoted(&maps.unit));
        line("scale", &format!("{:?}", maps.scale));
        if let Some([x, y]) = maps.pixel_mm {
            line("pixel_mm", &format!("[{x:?}, {y:?}]"));
        }
        if let Some(invalid) = maps.invalid {
            line("invalid", &format!("{invalid:?}"));
        }
    }
    if let Some(over) = task.over {
        line("over", &over.to_string());
    }
    if let Some(thresholds) = &task.thresholds {
        let (t, r) = (list(&thresholds.t), list(&thresholds.r));
        line("thresholds", &format!("{{ t = {t}, r = {r} }}"));
    }
    text
}

/// Texts as a TOML list.
fn list(texts: &[String]) -> String {
    let texts: Vec<String> = texts.iter().map(|text| quoted(text)).collect();
    format!("[{}]", texts.join(", "))
}
