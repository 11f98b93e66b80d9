//! Adapts built-in maps to the existing files and columns of a folder.

use std::path::Path;

use super::lines::{kept, without_section};
use crate::csv_table::CsvTable;
use crate::error::{ImportError, table_error};
use crate::foreign::ForeignTable;
use crate::import::ImportMap;
use crate::import::source::{has_match, matching_files};
use crate::layouts::{Fit, Layout};
use crate::source_folder::SourceFolder;
use taceva_dataset::ChannelOrder;
use taceva_dataset::internal::{decode, limits, read_capped};

/// Text of the map of `layout`, adapted to `folder`.
pub(super) fn text(layout: &Layout, folder: &SourceFolder) -> Result<String, ImportError> {
    let mut text = format!("{}\n", layout.map.trim_end());
    for instead in &layout.instead {
        if !has_match(folder.path(), &instead.absent) {
            for [from, to] in &instead.replace {
                text = text.replace(from, to);
            }
        }
    }
    for need in &layout.needs {
        text = text.replace(&need.any_of[0], there(folder, &need.any_of));
    }
    let text = match layout.fit {
        None | Some(Fit::Draft) => text,
        Some(Fit::Bristol) => bristol(text, folder)?,
        Some(Fit::DiffusionZarr) => diffusion_zarr(&text, folder)?,
        Some(Fit::Poseit) => poseit(&text, folder)?,
        Some(Fit::ToolForce) => tool_force(&text, folder)?,
        Some(Fit::Touchd) => touchd(&text, folder)?,
        Some(Fit::Univtac) => univtac(&text, folder)?,
    };
    let text = match layout.drops_absent_columns {
        true => {
            let table = first_table(&text, folder)?;
            with_time(&kept(&text, |_, column| is_there(&table, column)), &table)
        }
        false => text,
    };
    coloured(text, folder)
}

/// Path of the first file that matches `pattern`; an error without a match.
fn first(folder: &SourceFolder, pattern: &str) -> Result<std::path::PathBuf, ImportError> {
    let mut found = matching_files(folder, pattern)?;
    Ok(found.swap_remove(0))
}

/// First of `patterns` that a file matches, or the first pattern if no file matches any.
fn there<'p>(folder: &SourceFolder, patterns: &'p [String]) -> &'p str {
    let mut found = patterns
        .iter()
        .filter(|pattern| has_match(folder.path(), pattern));
    found.next().unwrap_or(&patterns[0])
}

/// First table that the map names.
fn first_table(text: &str, folder: &SourceFolder) -> Result<ForeignTable, ImportError> {
    // Parsed alone: the map may still hold alternative lines for the same channel.
    let table = text
        .lines()
        .find(|line| line.starts_with("table = "))
        .unwrap_or_default();
    let alone = format!(
        "map_version = 2\n{table}\n[frame]\npattern = \"x\"\nchannel_order = \"rgb\"\nreference = \"unknown\"\n[time]\nclock = \"unknown\"\n\
         [sensor]\nmodel = \"x\"\nserial = \"unknown\"\ngel = \"unknown\"\nopaque = \"unknown\"\n"
    );
    let map = ImportMap::parse(Path::new("preset.toml"), &alone)?;
    ForeignTable::read(&first(folder, &map.table)?, &map.form)
}

/// True if the table has the column, or the column of which `column` is an element. Path parts, row names and joined tables always count as present.
fn is_there(table: &ForeignTable, column: &str) -> bool {
    let base = column.rsplit_once('[').map_or(column, |(base, _)| base);
    column.starts_with("path.") || ["group", "key", "row"].contains(&column) || table.has(base)
}

/// Text of the map, without the time column if the table lacks it.
fn with_time(text: &str, table: &ForeignTable) -> String {
    let stated = text.split_once("[time]").and_then(|(_, time)| {
        let column = time
            .lines()
            .find_map(|line| line.strip_prefix("column = \""))?;
        column.strip_suffix('"')
    });
    match stated {
        Some(column) if !is_there(table, column) => {
            text.replace(&format!("column = \"{column}\"\nunit = \"s\"\n"), "")
        }
        _ => text.to_owned(),
    }
}

/// Sets gray as the colour order if the first picture is gray. Sets the picture without contact to `unknown` if its file is missing.
fn coloured(text: String, folder: &SourceFolder) -> Result<String, ImportError> {
    let reference = quoted(&text, "reference = \"").filter(|path| *path != "unknown");
    let text = match reference {
        Some(path) if !folder.path().join(path).exists() => text.replace(
            &format!("reference = \"{path}\""),
            "reference = \"unknown\"",
        ),
        _ => text,
    };
    let pictures = match (
        quoted(&text, "table = { files = \""),
        quoted(&text, "folder = \""),
    ) {
        (Some(files), _) => vec![files.to_owned()],
        (None, Some(".") | None) => return Ok(text),
        (None, Some(images)) => vec![format!("{images}/*.png"), format!("{images}/*.jpg")],
    };
    let found = pictures
        .iter()
        .find_map(|pattern| first(folder, pattern).ok());
    let Some(path) = found else {
        return Ok(text);
    };
    let bytes = read_capped(&path, limits::IMAGE_BYTES)?;
    Ok(match decode(&bytes, ChannelOrder::Gray) {
        Ok(_) => text.replace("channel_order = \"rgb\"", "channel_order = \"gray\""),
        Err(_) => text,
    })
}

/// Quoted text after `before` at the beginning of a line.
fn quoted<'t>(text: &'t str, before: &str) -> Option<&'t str> {
    let rest = text.lines().find_map(|line| line.strip_prefix(before))?;
    Some(rest.split_once('"')?.0)
}

/// Selects the map for numbered columns (`pose_1`) or for named columns, and drops force columns that contain only 0.0.
fn bristol(text: String, folder: &SourceFolder) -> Result<String, ImportError> {
    let table = CsvTable::read(&folder.file(folder.path(), "targets.csv")?)?;
    let mut text = match table.has("pose_1") {
        true => include_str!("../layouts/bristol-numbered.toml").to_owned(),
        false => text,
    };
    let mut has_force = false;
    for name in ["Fx", "Fy", "Fz"] {
        if table.has(name) {
            let forces = table.numbers_with_invalid(name)?;
            has_force |= forces.values().iter().any(|force| *force != 0.0);
        }
    }
    text = kept(&text, |name, column| {
        table.has(column) && (has_force || !name.starts_with('F'))
    });
    let exists = |name: &str| folder.path().join(name).exists();
    Ok(match !exists("sensor_images") && exists("images") {
        true => text
            .replace("folder = \"sensor_images\"", "folder = \"images\"")
            .replace("sensor_images/image_0.png", "images/image_0.png"),
        false => text,
    })
}

/// Selects the first sensor of the file in the map, and the left-hand pictures if there are two.
fn touchd(text: &str, folder: &SourceFolder) -> Result<String, ImportError> {
    let path = folder.file(folder.path(), "all_data_direction.json")?;
    let wrong = |problem: &str| ImportError::table(&path, problem);
    let bytes = read_capped(&path, limits::JSON_BYTES)?;
    let value: serde_json::Value =
        serde_json::from_slice(&bytes).map_err(|error| wrong(&format!("invalid JSON: {error}")))?;
    let first = value.as_object().and_then(|all| all.iter().next());
    let sensors = first.and_then(|(key, sensors)| Some((key, sensors.as_object()?)));
    let (key, sensors) = sensors.ok_or_else(|| {
        wrong("expected an object for each test object and speed, which holds a list of rows for each sensor")
    })?;
    let (sensor, rows) = sensors
        .iter()
        .next()
        .ok_or_else(|| wrong("the file has no sensor"))?;
    let number = rows
        .pointer("/0/0")
        .map(ToString::to_string)
        .unwrap_or_default();
    let is_left = folder
        .path()
        .join(format!("{key}/{sensor}/image_{number}_l.png"))
        .is_file();
    let name = if is_left {
        "image_{/0}_l.png"
    } else {
        "image_{/0}.png"
    };
    Ok(text
        .replace("/gelsight/", &format!("/{sensor}/"))
        .replace("image_{/0}.png", name))
}

/// Sets the actual column names of `f_t.csv` in the map, and `header` for `stages.csv` if the file has a header.
fn poseit(text: &str, folder: &SourceFolder) -> Result<String, ImportError> {
    let path = first(folder, "*/f_t.csv")?;
    let forces = CsvTable::read(&path)?;
    let [time, wrench @ ..] = forces.names() else {
        return Ok(text.to_owned());
    };
    if wrench.len() < 6 {
        return Err(table_error!(
            &path,
            "{} columns, expected 7: the time in s, three forces, three torques",
            wrench.len() + 1
        ));
    }
    let mut text = text.replace("column = \"time\"", &format!("column = {time:?}"));
    for (name, found) in ["Fx", "Fy", "Fz", "Tx", "Ty", "Tz"].into_iter().zip(wrench) {
        text = text.replace(
            &format!("from = \"ft.{name}\""),
            &format!("from = {:?}", format!("ft.{found}")),
        );
    }
    let stages = CsvTable::read(&first(folder, "*/stages.csv")?)?;
    Ok(match stages.names() {
        [name, second, ..] if second.parse::<f64>().is_err() => text
            .replace("stages.csv\", header = false }", "stages.csv\" }")
            .replace(
                "time = { column = 1,",
                &format!("time = {{ column = {second:?},"),
            )
            .replace("\"stages.0\"", &format!("{:?}", format!("stages.{name}"))),
        _ => text,
    })
}

/// Selects the last number of each line as the force.
fn tool_force(text: &str, folder: &SourceFolder) -> Result<String, ImportError> {
    let line = CsvTable::read_headerless(&first(folder, "*/force/force_data_*.txt")?)?;
    let last = line.names().len().saturating_sub(1);
    Ok(text.replace("\"force.0\"", &format!("\"force.{last}\"")))
}

/// Sets the names of the left gel and its pictures in the map.
fn univtac(text: &str, folder: &SourceFolder) -> Result<String, ImportError> {
    let table = first_table(text, folder)?;
    let text = match table.has("/tactile/left_gsmini/pose") || table.has("/tactile/left_gsmini/rgb")
    {
        true => text.to_owned(),
        false => text.replace("left_gsmini/", "left_tactile/"),
    };
    let pictures = quoted(&text, "bytes = \"").unwrap_or_default();
    let text = match table.has(pictures) {
        true => text,
        false => text.replace("/rgb\"", "/rgb_marker\""),
    };
    Ok(kept(&text, |_, column| is_there(&table, column)))
}

/// Sets the store, its `data` group, the first camera and the ends of episodes in the map.
fn diffusion_zarr(text: &str, folder: &SourceFolder) -> Result<String, ImportError> {
    let store = first(folder, "*.zarr")?;
    let name = store
        .file_name()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned();
    let mut text = text.replace("\"data.zarr\"", &format!("{name:?}"));
    if !store.join("data").is_dir() {
        text = text.replace(", rows = \"/data\"", "");
    }
    let table = first_table(&text, folder)?;
    let cameras = table.picture_columns();
    if !table.has("camera_0")
        && let Some(camera) = cameras.first()
    {
        text = text.replace("\"camera_0\"", &format!("{:?}", camera.name));
    }
    if !store.join("meta/episode_ends").is_dir() {
        text = without_section(&without_section(&text, "[[join]]"), "[ids]");
        text = text.replace("episode = \"episode.row\"\n", "");
    }
    Ok(kept(&text, |_, column| {
        column.starts_with("episode.") || is_there(&table, column)
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layouts::Preset;

    #[test]
    fn every_built_in_map_is_a_map() {
        let numbered = include_str!("../layouts/bristol-numbered.toml");
        let others = Preset::all()
            .filter(|preset| preset.facts().fit != Some(Fit::Draft))
            .map(|preset| preset.facts().map);
        for text in others.chain([numbered]) {
            ImportMap::parse(Path::new("preset.toml"), &kept(text, |_, _| true)).expect("a map");
        }
    }
}
