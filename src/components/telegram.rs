//! A telegram as the parts that show it take it.

use std::sync::Arc;

use buslens::field::hex;
use buslens::tool::link::Link;
use buslens::tool::{Detail, Options, Report, Telegram};

/// A telegram with all its details. Parts of the page hand it on, so it is shared.
#[derive(Clone, Debug)]
pub struct Shown(Arc<Details>);

#[derive(Debug)]
pub struct Details {
    /// What it is one of, and where in it.
    pub report: Arc<Report>,
    pub index: usize,
    pub telegram: Telegram,
    pub detail: Detail,
    /// How it was read.
    pub options: Options,
}

impl std::ops::Deref for Shown {
    type Target = Details;

    fn deref(&self) -> &Details {
        &self.0
    }
}

impl PartialEq for Shown {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Shown {
    /// Telegram `index` of a report that was read with `options`.
    pub fn of(report: &Arc<Report>, index: usize, options: &Options) -> Option<Self> {
        Some(Self(Arc::new(Details {
            report: report.clone(),
            index,
            telegram: report.telegrams.get(index)?.clone(),
            detail: report.detail(index)?,
            options: options.clone(),
        })))
    }
}

impl Details {
    pub fn bytes(&self) -> &[u8] {
        &self.telegram.line.bytes
    }

    /// A link to the telegram by itself, read as it is here.
    pub fn link(&self) -> Link {
        let options = Options {
            protocol: Some(self.telegram.choice.protocol),
            direction: Some(self.telegram.guess.direction),
            ..self.options.clone()
        };
        Link::to(hex(self.bytes()), options)
    }
}
