//! `taceva catalogue`.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use taceva_bundle::{
    AddRequest, CatalogueForm, add_to_catalogue, catalogue_entries, catalogue_form, check_bundles,
    check_catalogue, write_index,
};
use taceva_core::{counted, shown};
use taceva_report::catalogue::{self, Sensor};
use taceva_report::{SitePage, Table};

use super::{Context, Usage, results};
use crate::args::{
    CatalogueAdd, CatalogueArgs, CatalogueCheckArgs, CatalogueExport, CatalogueList, CatalogueShow,
    CatalogueSite, CatalogueSubject, Format, Output,
};
use crate::{exit, output};

pub(crate) fn run(args: &CatalogueArgs, context: &Context) -> anyhow::Result<u8> {
    match &args.subject {
        CatalogueSubject::List(args) => list(args),
        CatalogueSubject::Show(args) => show(args),
        CatalogueSubject::Site(args) => site(args, context),
        CatalogueSubject::Add(args) => add(args, context),
        CatalogueSubject::Check(args) => check(args, context),
        CatalogueSubject::Export(args) => export(args),
    }
}

fn list(args: &CatalogueList) -> anyhow::Result<u8> {
    let sensors = sensors(args.catalogue.as_deref())?;
    write(&args.output, &catalogue::list(&sensors))
}

fn show(args: &CatalogueShow) -> anyhow::Result<u8> {
    let sensors = sensors(args.catalogue.as_deref())?;
    let sensor = catalogue::named_among(&sensors, &args.name).map_err(|error| {
        let name = taceva_report::escape_terminal(&args.name);
        Usage::error(format!("`{name}`: {error}"))
    })?;
    let mut table = catalogue::details(&sensor);
    if let Some(line) = catalogue::listed_as(&args.name, &sensor) {
        table.caption = format!("{line}. {}", table.caption);
    }
    write(&args.output, &table)
}

fn write(args: &Output, table: &Table) -> anyhow::Result<u8> {
    if let Some(path) = &args.path {
        output::check_free(path, args.force)?;
    }
    results::write(table, args, || table.json("taceva.catalogue/1"))?;
    Ok(exit::DONE)
}

fn site(args: &CatalogueSite, context: &Context) -> anyhow::Result<u8> {
    let ours = results::read_all(&args.results)?;
    let pages = taceva_report::site(&sensors(args.catalogue.as_deref())?, &ours);
    check_names(&pages)?;
    fs::create_dir_all(&args.folder)
        .with_context(|| format!("cannot make {}", shown(&args.folder)))?;
    for page in &pages {
        output::check_free(&args.folder.join(&page.file), args.force)?;
    }
    for page in &pages {
        let path = args.folder.join(&page.file);
        output::write(Some(&path), |out| out.write_all(page.text.as_bytes()))?;
    }
    let first = args.folder.join("index.html");
    context.say(format_args!("look at    {}", shown(&first)));
    Ok(exit::DONE)
}

/// Fails if two pages have the same file name.
fn check_names(pages: &[SitePage]) -> anyhow::Result<()> {
    let mut known = BTreeSet::new();
    match pages.iter().find(|page| !known.insert(&page.file)) {
        Some(page) => bail!(
            "two sensors have the page {}: expected distinct names; `taceva catalogue check DIR` lists them",
            page.file
        ),
        None => Ok(()),
    }
}

/// Sensors of the built-in catalogue, merged with the entries of the catalogue in `folder`.
pub(super) fn sensors(folder: Option<&Path>) -> anyhow::Result<Vec<Sensor>> {
    Ok(match folder {
        None => catalogue::all(),
        Some(folder) => catalogue::joined(&catalogue_entries(folder)?),
    })
}

fn add(args: &CatalogueAdd, context: &Context) -> anyhow::Result<u8> {
    let mut request = AddRequest::new(&args.bundle, &args.catalogue);
    request.url.clone_from(&args.url);
    request.most = args.most;
    request.jobs = context.jobs;
    let added = add_to_catalogue(&request)?;
    output::write(None, |out| {
        for entry in &added.entries {
            writeln!(out, "wrote    {}", shown(&args.catalogue.join(entry)))?;
        }
        writeln!(
            out,
            "rows     {} measured, {} of unknown origin, {} simulated",
            added.measured, added.unknown, added.simulated
        )?;
        writeln!(out, "verified to the level {} or deeper", added.level)?;
        match &added.badge {
            Some(badge) => writeln!(out, "{badge}"),
            None => Ok(()),
        }
    })?;
    Ok(exit::DONE)
}

fn export(args: &CatalogueExport) -> anyhow::Result<u8> {
    let root = args.catalogue.as_path();
    let wanted = [
        (CatalogueForm::Hub, args.hub.as_deref()),
        (CatalogueForm::Croissant, args.croissant.then_some(root)),
        (CatalogueForm::Crate, args.ro_crate.then_some(root)),
    ];
    if wanted.iter().all(|(_, folder)| folder.is_none()) {
        let problem = "name a form: --hf FOLDER, --croissant or --crate";
        return Err(Usage::error(problem));
    }
    let mut files: BTreeMap<PathBuf, String> = BTreeMap::new();
    for (form, folder) in wanted {
        let Some(folder) = folder else { continue };
        let of_form = catalogue_form(root, form, args.organization.as_ref())?;
        files.extend(
            of_form
                .into_iter()
                .map(|file| (folder.join(file.path), file.text)),
        );
    }
    output::check_all_free(files.keys(), args.force)?;
    for (path, text) in &files {
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder).with_context(|| format!("cannot make {}", shown(folder)))?;
        }
        output::write(Some(path), |out| out.write_all(text.as_bytes()))?;
    }
    output::write(None, |out| {
        let mut paths = files.keys();
        paths.try_for_each(|path| writeln!(out, "wrote    {}", shown(path)))
    })?;
    Ok(exit::DONE)
}

fn check(args: &CatalogueCheckArgs, context: &Context) -> anyhow::Result<u8> {
    if let Some(path) = &args.output.path {
        output::check_free(path, args.output.force)?;
    }
    let mut found = check_catalogue(&args.catalogue)?;
    let of_bundles = check_bundles(&args.catalogue, &args.bundles, context.jobs)?;
    found.findings.extend(of_bundles);
    let caption = format!(
        "{} in {}, {} and {}",
        counted(found.findings.len() as u64, "finding"),
        counted(found.entries, "entry"),
        counted(found.bundles, "bundle"),
        counted(found.numbers, "number"),
    );
    let to = &args.output;
    if found.findings.is_empty() && matches!(to.format, Format::Text | Format::Md) {
        write_index(&args.catalogue, &found)?;
        output::write_as(to.format, to.path.as_deref(), |out| {
            writeln!(out, "{caption}")
        })?;
        return Ok(exit::DONE);
    }
    let mut table = Table::new(caption, ["file", "line", "finding"]);
    for finding in &found.findings {
        let line = finding
            .line
            .map_or_else(String::new, |line| line.to_string());
        table.push([finding.path.clone(), line, finding.problem.clone()]);
    }
    results::write(&table, to, || table.json("taceva.catalogue-check/1"))?;
    if !found.findings.is_empty() {
        return Ok(exit::CHECK_FAILED);
    }
    write_index(&args.catalogue, &found)?;
    Ok(exit::DONE)
}
