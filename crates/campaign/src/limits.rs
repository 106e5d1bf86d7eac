//! Limits by which a campaign is judged: the text of every file, so that a plan is whole without them.

use ttb_assessment::criterion::DEFAULT;
use ttb_assessment::{Criteria, Facts};

use crate::error::Error;
use crate::identity;

/// Name and content of every file; none: the bundled ones.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Limits {
    /// Name and content of a file.
    pub texts: Vec<[String; 2]>,
}

impl Limits {
    /// What they say.
    ///
    /// # Errors
    /// Every problem in them, a line each.
    pub fn criteria(&self) -> Result<Criteria, Error> {
        let read = match self.texts.as_slice() {
            [] => Criteria::bundled(DEFAULT),
            texts => Criteria::read(texts.iter().map(|[name, text]| (name.as_str(), text.as_str()))),
        };
        let told = |problems: Vec<_>| problems.iter().map(ToString::to_string).collect::<Vec<String>>().join("\n");
        read.map_err(|problems| Error::Input(told(problems)))
    }

    /// A short word for the reduced values that they ask for of a bridge; empty if they are those of the bundled ones. A limit
    /// that has another number asks for the same values.
    #[must_use]
    pub fn values(&self, facts: &Facts) -> String {
        let wanted = |limits: &Self| {
            let mut wanted: Vec<String> = limits.criteria().map_or_else(
                |_| Vec::new(),
                |criteria| {
                    let facts = facts.overruled_by(&criteria.facts);
                    criteria.wanted(&facts).iter().map(|one| format!("{one:?}")).collect()
                },
            );
            wanted.sort_unstable();
            wanted
        };
        let own = wanted(self);
        if own == wanted(&Self::default()) { String::new() } else { identity::of(&own) }
    }
}
