//! `taceva wear`.

use anyhow::Context as _;
use taceva_core::{Amount, shown};
use taceva_dataset::Dataset;
use taceva_stress::{ByChannel, WearBy, WearRequest, wear};

use super::quantity::Quantity;
use super::stress::check_model_file;
use super::{Context, Usage, open_seen, results};
use crate::args::{Format, Wear, WearByArg};
use crate::report::wear::{numbers, table};
use crate::{exit, output};

pub(crate) fn run(args: &Wear, context: &Context) -> anyhow::Result<u8> {
    if let Some(path) = &args.output.path {
        output::check_free(path, args.output.force)?;
    }
    check_model_file(&args.model)?;
    let request = WearRequest {
        by: args.by.map(|by| match by {
            WearByArg::Presses => WearBy::Presses,
            WearByArg::Date => WearBy::Date,
        }),
        limits: limits(&args.limit)?,
    };
    let model = context.models()?.open(&args.model)?;
    let opened = args.datasets.iter();
    let opened = opened.map(|path| open_seen(std::slice::from_ref(path), &args.view, Some(&model)));
    let recordings = opened.collect::<anyhow::Result<Vec<Dataset>>>()?;
    let applied = || super::applied(&args.model, &args.datasets);
    let found = wear(&recordings, &model, &request, context.work(None)).with_context(applied)?;
    let written = match args.output.format {
        Format::Csv => numbers(&found),
        _ => table(&found),
    };
    let json = serde_json::to_string_pretty(&found)?;
    results::write(&written, &args.output, || format!("{json}\n"))?;
    Ok(exit::DONE)
}

/// Limits by channel, each as `mae.CHANNEL=AMOUNT`.
fn limits(words: &[String]) -> anyhow::Result<ByChannel<Amount>> {
    let mut limits = ByChannel::new();
    for word in words {
        let refused = |problem: &str| Usage::error(format!("--limit `{}`: {problem}", shown(word)));
        let parts = word.strip_prefix("mae.").and_then(|of| of.split_once('='));
        let Some((channel, amount)) = parts else {
            return Err(refused(
                "expected mae.CHANNEL=AMOUNT, a number with its unit, such as mae.Fz=0.1N",
            ));
        };
        let Quantity { value, unit, .. } = Quantity::read("--limit", amount)?;
        let before = limits.insert(channel.to_owned(), Amount { value, unit });
        if before.is_some() {
            return Err(refused(
                "two limits of this channel, expected one for each channel",
            ));
        }
    }
    Ok(limits)
}
