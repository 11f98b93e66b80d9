//! `taceva fit`.

use std::io::{self, Write};

use taceva_study::{Fitted, fit};

use super::{Context, fit_request, open};
use crate::args::Fit;
use crate::{exit, output};

pub(crate) fn run(args: &Fit, context: &Context) -> anyhow::Result<u8> {
    output::check_free(&args.out, args.force)?;
    for path in args.split_out.iter() {
        output::check_free(path, args.force)?;
    }
    let dataset = open(&args.dataset)?;
    let models = context.models()?;
    let request = fit_request(&args.model.name, &args.model.settings, &args.split, &models)?;
    let fitted = fit(&dataset, &request, context.jobs, &context.progress)?;
    fitted.model.save(&args.out)?;
    if let Some(path) = &args.split_out {
        output::write(Some(path), |out| {
            serde_json::to_writer_pretty(&mut *out, &fitted.manifest)?;
            writeln!(out)
        })?;
    }
    output::write(None, |out| summary(&fitted, args, out))?;
    Ok(exit::DONE)
}

/// What was learnt from, what was chosen, and where the model is.
fn summary(fitted: &Fitted, args: &Fit, out: &mut dyn Write) -> io::Result<()> {
    let card = fitted.model.card();
    writeln!(out, "model    {} on {}", card.model, card.features)?;
    let counts = &fitted.manifest.counts;
    writeln!(
        out,
        "split    {}, seed {}: train {}, validation {}, test {}",
        fitted.manifest.split, fitted.manifest.seed, counts.train, counts.validation, counts.test
    )?;
    for (channel, choice) in card.channels.iter().zip(&card.choice.channels) {
        let setting = card.choice.setting.as_deref().zip(choice.value);
        let chosen =
            setting.map_or_else(String::new, |(name, value)| format!("  {name} {value:.3e}"));
        let error = choice.rmse.map_or_else(String::new, |rmse| {
            format!("  rmse {rmse:.4} {}", channel.unit)
        });
        let edge = if choice.at_edge {
            "  (at the edge of what was tried)"
        } else {
            ""
        };
        let constant = if channel.constant_label {
            "  (constant label)"
        } else {
            ""
        };
        writeln!(
            out,
            "channel  {}{chosen}{error}{edge}{constant}",
            channel.name
        )?;
    }
    if fitted.left_out > 0 {
        writeln!(
            out,
            "left out {} samples without a label or a frame",
            fitted.left_out
        )?;
    }
    writeln!(out, "wrote    {}", args.out.display())
}
