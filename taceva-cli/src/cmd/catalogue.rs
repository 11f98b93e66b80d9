//! `taceva catalogue`.

use std::fs;
use taceva_core::shown;

use anyhow::Context as _;
use taceva_report::catalogue;

use super::{Context, Usage, results};
use crate::args::{CatalogueArgs, CatalogueShow, CatalogueSite, CatalogueSubject, Output};
use crate::{exit, output};

pub(crate) fn run(args: &CatalogueArgs, context: &Context) -> anyhow::Result<u8> {
    match &args.subject {
        CatalogueSubject::List(output) => list(output),
        CatalogueSubject::Show(args) => show(args),
        CatalogueSubject::Site(args) => site(args, context),
    }
}

fn list(output: &Output) -> anyhow::Result<u8> {
    write(output, &catalogue::list(&catalogue::all()))
}

fn show(args: &CatalogueShow) -> anyhow::Result<u8> {
    let sensor = catalogue::named(&args.name).map_err(|error| {
        let name = taceva_report::escape_terminal(&args.name);
        Usage::error(format!("`{name}`: {error}"))
    })?;
    let mut table = catalogue::details(&sensor);
    if let Some(line) = catalogue::listed_as(&args.name, &sensor) {
        table.caption = format!("{line}. {}", table.caption);
    }
    write(&args.output, &table)
}

fn write(args: &Output, table: &taceva_report::Table) -> anyhow::Result<u8> {
    if let Some(path) = &args.path {
        output::check_free(path, args.force)?;
    }
    results::write(table, args, || table.json("taceva.catalogue/1"))?;
    Ok(exit::DONE)
}

fn site(args: &CatalogueSite, context: &Context) -> anyhow::Result<u8> {
    let ours = results::read_all(&args.results)?;
    let pages = taceva_report::site(&catalogue::all(), &ours);
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
