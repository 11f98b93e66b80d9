//! `taceva evaluate --task`.

use taceva_evaluate::{evaluate_task, usual_model};

use super::super::{Context, cache, fit_request, open_seen, task_scores};
use super::check_folders;
use crate::args::Evaluate;
use crate::{exit, output};

pub(super) fn run(name: &str, args: &Evaluate, context: &Context) -> anyhow::Result<u8> {
    let (state_out, page) = (&args.scoring.state_out, &args.scoring.page);
    let files = args.output.path.iter().chain(state_out).chain(&page.path);
    output::check_all_free(files, args.output.force)?;
    check_folders(&args.datasets)?;
    let models = context.models()?;
    let dataset = open_seen(&args.datasets, &args.view, None)?;
    let usual = usual_model(&dataset, name);
    let model = args.model.name.as_deref().unwrap_or_else(|| {
        context.say(format_args!("model: {usual}, because --model is not given"));
        usual
    });
    let settings = args.window.on(&args.model.settings);
    let fit = fit_request(model, &settings, &args.split, &models)?;
    let cache = cache::of(&args.cache);
    let states = evaluate_task(&dataset, name, fit, context.work(cache.as_ref()))?;
    cache::note(cache.as_ref(), context);
    let report = task_scores::write(&states, &args.output, state_out.as_deref())?;
    task_scores::write_page(&report, page, Some(&dataset))?;
    Ok(exit::DONE)
}
