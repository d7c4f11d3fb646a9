(* `ring` and `field` that reckon with rational numbers. Coq's own know whole numbers: they multiply the denominators of
   all coefficients, and of twenty coefficients with forty digits each product then has a thousand. A file loads this
   where its coefficients are long. *)
Require Import Reals QArith Qreals Qreduction RealField.
Require Export Workbench.
Open Scope R_scope.

Definition rational (q : Q) : R :=
  match Qden q, Qnum q with
  | xH, n => IZR n
  | d, Zpos xH => / IZR (Zpos d)
  | d, n => IZR n / IZR (Zpos d)
  end.

Lemma rational_is : forall q, rational q = Q2R q.
Proof.
  intros [[|[n|n|]|n] [d|d|]]; unfold rational, Q2R, Rdiv; simpl Qnum; simpl Qden; cbv iota; try reflexivity;
    rewrite ?Rinv_1, ?Rmult_1_r, ?Rmult_1_l; reflexivity.
Qed.

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

(* 1 / b is no constant, which to `rational` is / b *)
Ltac rational_tac t :=
  match t with
  | IZR (Zpos xH) / _ => constr:(InitialRing.NotConstant)
  | IZR ?a / IZR (Zpos ?b) =>
    match isZcst a with
    | true => match isPcst b with true => constr:(Qmake a b) | _ => constr:(InitialRing.NotConstant) end
    | _ => constr:(InitialRing.NotConstant)
    end
  | / IZR (Zpos ?b) => match isPcst b with true => constr:(Qmake (Zpos xH) b) | _ => constr:(InitialRing.NotConstant) end
  | IZR ?a => match isZcst a with true => constr:(Qmake a xH) | _ => constr:(InitialRing.NotConstant) end
  | _ => constr:(InitialRing.NotConstant)
  end.

Ltac as_numbers := cbv [rational Qnum Qden].

Add Field rational_numbers : Rfield (completeness rationals_told_apart, morphism rationals,
  constants [rational_tac], power_tac R_power_theory [Rpow_tac], postprocess [as_numbers]).

(* `ring` sees no polynomial where something is divided by a number, but one where it is multiplied by its inverse *)
Ltac same ::= try reflexivity; solve [ try unfold Rdiv; ring | field; nonzero ].
