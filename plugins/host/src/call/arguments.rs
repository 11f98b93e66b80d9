//! Driver arguments in the form of the plugin interface.

use taceva_abi as abi;
use taceva_core::{ArgSpec, ArgValue, Args};

/// Arguments in the form of the plugin interface. The arguments point to texts that this value owns.
pub struct ArgList {
    items: Vec<abi::Arg>,
    // Heap texts that the items point to. They stay in place when the list moves.
    _texts: Vec<(String, String)>,
}

impl ArgList {
    /// Converts the arguments in `args` that `specs` declare.
    pub fn new(args: &Args, specs: &[ArgSpec]) -> ArgList {
        let given = specs
            .iter()
            .filter_map(|spec| Some((spec, args.get(&spec.key)?)));
        let (mut items, mut texts) = (Vec::new(), Vec::new());
        for (spec, value) in given {
            texts.push((spec.key.clone(), value.to_string()));
            let (key, text) = texts.last().expect("it was pushed");
            let (kind, whole, number) = match *value {
                ArgValue::Text(_) => (abi::Arg::TEXT, 0, 0.0),
                ArgValue::Whole(whole) => (abi::Arg::WHOLE, whole, 0.0),
                ArgValue::Number(number) => (abi::Arg::NUMBER, 0, number),
                ArgValue::Flag(flag) => (abi::Arg::FLAG, i64::from(flag), 0.0),
                // A value of an unknown kind is passed as text.
                _ => (abi::Arg::TEXT, 0, 0.0),
            };
            items.push(abi::Arg {
                key: abi::Text::from(key),
                text: abi::Text::from(text),
                whole,
                number,
                kind,
                reserved: 0,
            });
        }
        ArgList {
            items,
            _texts: texts,
        }
    }

    /// Argument array for the plugin. Valid as long as the list exists.
    pub fn args(&self) -> abi::Args {
        abi::Args {
            items: self.items.as_ptr(),
            count: self.items.len(),
        }
    }
}
