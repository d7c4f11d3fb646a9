(* `ring` and `field` that reckon with rational numbers. Coq's own know whole numbers: they multiply the denominators of
   all coefficients, and of twenty coefficients with forty digits each product then has a thousand. A file loads this
   where its coefficients are long. *)
Require Import Reals QArith Qreals Qreduction RealField.
Require Export Workbench.
Open Scope R_scope.

Definition rational (q : Q) : R :=
  match Qden q with xH => IZR (Qnum q) | d => IZR (Qnum q) / IZR (Zpos d) end.

Lemma rational_is : forall q, rational q = Q2R q.
Proof. intros [a [d|d|]]; unfold rational, Q2R; simpl; try reflexivity. field. Qed.

Lemma rationals : ring_morph 0 1 Rplus Rmult Rminus Ropp (@eq R)
  0%Q 1%Q Qplus' Qmult' Qminus' Qopp Qeq_bool rational.
Proof.
  split; try reflexivity; intros; rewrite ?rational_is.
  - rewrite (Qeq_eqR _ _ (Qplus'_correct x y)). apply Q2R_plus.
  - rewrite (Qeq_eqR _ _ (Qminus'_correct x y)). apply Q2R_minus.
  - rewrite (Qeq_eqR _ _ (Qmult'_correct x y)). apply Q2R_mult.
  - apply Q2R_opp.
  - apply Qeq_eqR, Qeq_bool_eq. assumption.
Qed.

Lemma rationals_told_apart : forall x y, rational x = rational y -> Qeq_bool x y = true.
Proof. intros x y E. rewrite !rational_is in E. apply Qeq_eq_bool, eqR_Qeq, E. Qed.

Ltac rational_tac t :=
  match t with
  | IZR ?a / IZR (Zpos ?b) =>
    match isZcst a with
    | true => match isPcst b with true => constr:(Qmake a b) | _ => constr:(InitialRing.NotConstant) end
    | _ => constr:(InitialRing.NotConstant)
    end
  | IZR ?a => match isZcst a with true => constr:(Qmake a xH) | _ => constr:(InitialRing.NotConstant) end
  | _ => constr:(InitialRing.NotConstant)
  end.

Ltac as_numbers := cbv [rational Qnum Qden].

Add Field rational_numbers : Rfield (completeness rationals_told_apart, morphism rationals,
  constants [rational_tac], power_tac R_power_theory [Rpow_tac], postprocess [as_numbers]).

(* what is divided by a number is no polynomial to `ring`, which would be tried in vain *)
Ltac same ::= try reflexivity;
  first [ match goal with |- context [(_ * _) / IZR _] => solve [ field; nonzero ] end
        | solve [ ring | field; nonzero ] ].
