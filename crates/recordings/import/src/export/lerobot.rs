//! Export as a LeRobot folder, version 3.0, with the pictures in its tables.
//!
//! An episode is a press: consecutive rows of one sensor unit, scene, contact point and repeat. LeRobot treats the rows of an episode as consecutive frames.
//! Repeats of a contact point may be hours apart, with other presses in between, so they form separate episodes. Episodes are runs of rows, so rows keep their
//! order.

use std::collections::BTreeMap;

use taceva_core::Frame;
use taceva_tables::{
    Cell, FeatureStats, LeRobotWriter, WrittenColumn, WrittenFeature, WrittenKind,
};

use super::cells;
use super::cells::of_table;
use super::content::Exported;
use super::map::{Written, WrittenFrames, quoted};
use super::picture::Pictures;
use crate::error::ImportError;
use taceva_dataset::Table;
use taceva_dataset::internal::{RESERVED, staging::StagedFolder};

const STATE: &str = "observation.state";
const TAXELS: &str = "observation.tactile";
/// Prefix of the feature names of pictures. The name of the view follows, or `gel` for samples with one picture.
const PICTURES: &str = "observation.images";
/// Number of pictures used for the statistics, about as many as LeRobot itself uses.
const LOOKED_AT: usize = 100;

pub(super) fn write(
    exported: &Exported<'_>,
    staged: &StagedFolder,
) -> Result<(Written, Vec<String>), ImportError> {
    let dataset = exported.dataset;
    let (header, table) = (dataset.header(), dataset.table());
    let model = header.sensor.model.as_str();
    let rate_hz = rate_hz(table);
    let mut writer = LeRobotWriter::create(staged.path(), model, rate_hz, features(exported))
        .map_err(of_table)?;
    let task = format!("press {model}");
    let stats = exported.pictures.iter();
    let stats = stats.map(|pictures| FeatureStats::new(pictures.colours()));
    let mut stats: Vec<FeatureStats> = stats.collect();
    let looked_at = table.rows().div_ceil(LOOKED_AT);
    for row in 0..table.rows() {
        if row == 0 || !is_same_press(table, row - 1, row) {
            writer.begin_episode(&task).map_err(of_table)?;
        }
        writer.push(cells_of(exported, row)?).map_err(of_table)?;
        let is_looked_at = row % looked_at == 0;
        let looked_at = stats.iter_mut().zip(&exported.pictures);
        for (stats, pictures) in looked_at.filter(|_| is_looked_at) {
            add_picture(stats, &pictures.frame(row)?);
        }
        exported.advance(1)?;
    }
    let names = exported.pictures.iter().map(picture_name);
    let stats: BTreeMap<String, FeatureStats> = names.zip(stats).collect();
    let folders = writer.finish(&stats).map_err(of_table)?;
    let mut frames = Vec::new();
    for pictures in &exported.pictures {
        let name = picture_name(pictures);
        frames.push(WrittenFrames {
            key: format!("bytes = {}", quoted(&format!("{name}.bytes"))),
            reference: exported.write_reference(staged, pictures)?,
        });
    }
    let written = Written {
        table: "{ file = \".\", format = \"lerobot\" }".to_owned(),
        frames,
        signals: header.signals.as_ref().map(|_| quoted(TAXELS)),
        names: name_of,
        channels: match table.channels().len() {
            1 => vec![STATE.to_owned()],
            several => (0..several)
                .map(|position| format!("{STATE}[{position}]"))
                .collect(),
        },
    };
    Ok((written, folders))
}

/// Feature name of `pictures`.
fn picture_name(pictures: &Pictures<'_>) -> String {
    let view = pictures.view();
    format!("{PICTURES}.{}", view.as_deref().unwrap_or("gel"))
}

/// Feature name of a column. Attributes get a prefix, to differ from the columns that LeRobot defines.
fn name_of(name: &str) -> String {
    match RESERVED.contains(&name) {
        true => name.to_owned(),
        false => format!("attribute.{name}"),
    }
}

/// Columns other than channels. The channels form one feature.
fn labels<'e, 'd>(
    exported: &'e Exported<'d>,
) -> impl Iterator<Item = &'e taceva_dataset::internal::NamedColumn<'d>> {
    let channels = exported.dataset.table().channels();
    let columns = exported.columns.iter();
    columns.filter(|column| channels.position(column.name).is_none())
}

fn features(exported: &Exported<'_>) -> Vec<WrittenFeature> {
    let header = exported.dataset.header();
    let channels = &header.channels;
    let mut features = Vec::new();
    for pictures in &exported.pictures {
        let Some(info) = pictures.info() else {
            continue;
        };
        let column = WrittenColumn::new(picture_name(pictures), WrittenKind::Picture);
        let shape = [
            info.height.into(),
            info.width.into(),
            info.format.samples() as u64,
        ];
        let feature = WrittenFeature::new(column, shape);
        features.push(feature.with_names(["height", "width", "channels"]));
    }
    if !channels.is_empty() {
        let column = WrittenColumn::new(STATE, WrittenKind::Numbers(Some(channels.len())));
        let units: Vec<&str> = channels
            .iter()
            .map(|channel| channel.unit().symbol())
            .collect();
        let feature = WrittenFeature::new(column, [channels.len() as u64]);
        let feature = feature.with_names(channels.iter().map(|channel| channel.name()));
        features.push(feature.with_unit(units.join(" ")));
    }
    if let Some(signals) = &header.signals {
        let length = signals.spec.info.len();
        let column = WrittenColumn::new(TAXELS, WrittenKind::Singles(Some(length)));
        let feature = WrittenFeature::new(column, [length as u64]);
        let feature = feature.with_names(signals.spec.column_names());
        features.push(feature.with_unit(signals.spec.info.unit.symbol()));
    }
    for label in labels(exported) {
        let column = WrittenColumn::new(name_of(label.name), cells::kind(&label.cells));
        let feature = WrittenFeature::new(column, [1]);
        features.push(match label.name {
            "t_s" => feature.with_unit("s"),
            "spacing_mm" | "zero_u_mm" => feature.with_unit("mm"),
            _ => feature,
        });
    }
    features
}

/// Cells of a row, in the order of the features.
fn cells_of(exported: &Exported<'_>, row: usize) -> Result<Vec<Cell>, ImportError> {
    let table = exported.dataset.table();
    let mut row_cells = Vec::new();
    for pictures in &exported.pictures {
        let encoded = pictures.encoded(row)?.ok_or_else(|| pictures.none(row))?;
        row_cells.push(cells::picture(Some(encoded), &table.samples()[row]));
    }
    if !table.channels().is_empty() {
        // LeRobot rejects nulls among numbers.
        let channels = 0..table.channels().len();
        let values = channels.map(|position| table.truth(position).get(row).unwrap_or(f64::NAN));
        row_cells.push(Cell::List(values.map(Cell::Number).collect()));
    }
    if exported.dataset.header().signals.is_some() {
        row_cells.push(exported.signals_cell(row)?);
    }
    row_cells.extend(labels(exported).map(|label| cells::cell(&label.cells, row)));
    Ok(row_cells)
}

/// True if two consecutive rows belong to the same press.
fn is_same_press(table: &Table, before: usize, row: usize) -> bool {
    table.point_id()[before] == table.point_id()[row]
        && table.repeat()[before] == table.repeat()[row]
        && table.unit_id()[before] == table.unit_id()[row]
        && table.scene()[before] == table.scene()[row]
}

/// Frame rate within presses, in whole Hz as LeRobot requires, from the median time step; 1 if times are missing.
fn rate_hz(table: &Table) -> f64 {
    let pairs = (1..table.rows()).filter(|row| is_same_press(table, row - 1, *row));
    let steps = pairs.filter_map(|row| Some(table.t_s()[row]? - table.t_s()[row - 1]?));
    let mut steps: Vec<f64> = steps.filter(|step| *step > 0.0).collect();
    steps.sort_by(f64::total_cmp);
    let median = steps.get(steps.len() / 2);
    median.map_or(1.0, |step| (1.0 / step).round().clamp(1.0, 1e6))
}

/// Adds the pixels of a picture, scaled to the range 0 to 1, to `stats`.
fn add_picture(stats: &mut FeatureStats, frame: &Frame) {
    let format = frame.info().format;
    let full = f64::from(format.full_scale());
    match format.bytes_per_sample() {
        1 => stats.add_picture(frame.bytes().iter().map(|pixel| f64::from(*pixel) / full)),
        _ => stats.add_picture(
            frame
                .bytes()
                .chunks_exact(2)
                .map(|pair| f64::from(u16::from_le_bytes([pair[0], pair[1]])) / full),
        ),
    }
}
