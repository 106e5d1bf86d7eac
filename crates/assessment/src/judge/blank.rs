//! Verdicts before a value has filled them.

use super::Judge;
use crate::criterion::ResolvedFilter;
use crate::verdict::{Status, Verdict};

impl Judge<'_> {
    /// Not judged, and why.
    pub(super) fn not_judged(&self, reason: String, filter: Option<ResolvedFilter>) -> Verdict {
        Verdict { status: Status::NotJudged, reason: Some(reason), ..self.empty(filter) }
    }

    /// What the criterion says, without a value.
    pub(super) fn empty(&self, filter: Option<ResolvedFilter>) -> Verdict {
        let criterion = self.criterion.clone();
        Verdict {
            criterion: criterion.id,
            title: criterion.title,
            status: Status::NotJudged,
            value: None,
            limit: None,
            utilisation: None,
            unit: criterion.unit,
            raw: None,
            quantity: criterion.quantity,
            statistic: criterion.statistic.name().into(),
            filter: filter.map_or_else(String::new, |filter| filter.filter.label()),
            filter_assumed: filter.is_some_and(|filter| filter.assumed),
            grade: None,
            basis: None,
            in_basis: true,
            runs: 0,
            run_id: None,
            train: None,
            speed_km_h: None,
            variant: None,
            seed: None,
            place: None,
            x_m: None,
            time_s: None,
            permissible_speed_km_h: None,
            first_exceeded_km_h: None,
            clause: criterion.clause,
            edition: criterion.edition,
            verified: criterion.verified,
            source: criterion.source,
            limits: criterion.file,
            reason: None,
            note: criterion.note,
        }
    }
}
