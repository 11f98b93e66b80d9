//! Export as a Hugging Face dataset: Parquet with the pictures in the column `image`.

use taceva_core::markdown;
use taceva_tables::{ParquetWriter, WrittenColumn, WrittenKind, huggingface_features};

use super::cells;
use super::cells::of_table;
use super::content::Exported;
use super::map::{self, Written, WrittenFrames, quoted};
use crate::error::ImportError;
use taceva_dataset::internal::{staging::StagedFolder, write_durable};

/// Path of the file within the folder.
const FILE: &str = "data/train-00000-of-00001.parquet";

pub(super) fn write(
    exported: &Exported<'_>,
    staged: &StagedFolder,
) -> Result<(Written, Vec<String>), ImportError> {
    staged.create_folder("data")?;
    let dataset = exported.dataset;
    let signals = dataset.header().signals.as_ref();
    let images = exported.pictures.iter();
    let images = images.map(|pictures| exported.free_name(&pictures.named("image")));
    let images: Vec<String> = images.collect();
    let taxels = signals.map(|_| exported.free_name("signals"));
    let columns = exported.columns.iter();
    let columns = columns.map(|column| WrittenColumn::new(column.name, cells::kind(&column.cells)));
    let mut columns: Vec<WrittenColumn> = columns.collect();
    if let (Some(name), Some(signals)) = (&taxels, signals) {
        let kind = WrittenKind::Singles(Some(signals.spec.info.len()));
        columns.push(WrittenColumn::new(name, kind));
    }
    columns.extend(
        images
            .iter()
            .map(|name| WrittenColumn::new(name, WrittenKind::Picture)),
    );
    let mut metadata = vec![
        ("huggingface".to_owned(), huggingface_features(&columns)),
        (
            "taceva.source".to_owned(),
            format!("{:?}", dataset.header().source).to_lowercase(),
        ),
    ];
    let channels = dataset.table().channels().iter();
    metadata.extend(channels.map(|channel| {
        (
            format!("unit.{}", channel.name()),
            channel.unit().symbol().to_owned(),
        )
    }));
    if let (Some(name), Some(signals)) = (&taxels, signals) {
        metadata.push((
            format!("unit.{name}"),
            signals.spec.info.unit.symbol().to_owned(),
        ));
    }
    let metadata: Vec<(&str, &str)> = metadata
        .iter()
        .map(|(key, text)| (key.as_str(), text.as_str()))
        .collect();
    let mut writer =
        ParquetWriter::create(&staged.path().join(FILE), &columns, &metadata).map_err(of_table)?;
    for row in 0..dataset.table().rows() {
        let own = exported.columns.iter();
        let mut cells: Vec<_> = own.map(|column| cells::cell(&column.cells, row)).collect();
        if signals.is_some() {
            cells.push(exported.signals_cell(row)?);
        }
        for pictures in &exported.pictures {
            let sample = &dataset.table().samples()[row];
            cells.push(cells::picture(pictures.encoded(row)?, sample));
        }
        writer.push(cells).map_err(of_table)?;
        exported.advance(1)?;
    }
    writer.finish().map_err(of_table)?;
    let card = staged.path().join("README.md");
    write_durable(&card, card_of(exported, taxels.as_deref()).as_bytes())?;
    let mut frames = Vec::new();
    for (pictures, name) in exported.pictures.iter().zip(&images) {
        frames.push(WrittenFrames {
            key: format!("bytes = {}", quoted(&format!("{name}.bytes"))),
            reference: exported.write_reference(staged, pictures)?,
        });
    }
    let written = Written {
        table: quoted(FILE),
        frames,
        signals: taxels.map(|name| quoted(&name)),
        names: map::bare,
        channels: map::bare_channels(exported),
    };
    Ok((written, vec!["data".to_owned()]))
}

/// Text of the dataset card: the sensor, the units, and the source of the data.
fn card_of(exported: &Exported<'_>, taxels: Option<&str>) -> String {
    let dataset = exported.dataset;
    let header = dataset.header();
    let mut card = format!(
        "# {}\n\nSamples: {}. Source: {:?}. Exported from the dataset {}.\n\n| column | unit |\n|---|---|\n",
        markdown(&header.sensor.model),
        dataset.table().rows(),
        header.source,
        dataset.digest()
    );
    for channel in dataset.table().channels() {
        let name = markdown(channel.name());
        card += &format!("| {name} | {} |\n", channel.unit().symbol());
    }
    if let (Some(name), Some(signals)) = (taxels, &header.signals) {
        card += &format!("| {name} | {} |\n", signals.spec.info.unit.symbol());
        let names = signals.spec.column_names();
        let names: Vec<String> = names.map(|name| markdown(&name)).collect();
        card += &format!("\n`{name}` holds, in this order: {}.\n", names.join(", "));
    }
    if !header.traceability.is_empty() {
        card += "\nTraceability of the labels:\n";
    }
    for traced in &header.traceability {
        card += &format!("- {}\n", markdown(&traced.to_string()));
    }
    card
}
