"use strict";(()=>{function ie(n){return n==="inf"?1/0:n==="-inf"?-1/0:typeof n=="number"?n:NaN}var ea=new DataView(new ArrayBuffer(8));function Yf(n){let t=Math.abs(n);return ea.setFloat64(0,t),ea.setBigInt64(0,ea.getBigInt64(0)+1n),ea.getFloat64(0)-t}function Cs(n,t){let e=n*t,i=134217729*n,s=i-(i-n),r=n-s;i=134217729*t;let o=i-(i-t),a=t-o;return[e,r*a-(e-s*o-r*o-s*a)]}function Zf(n){let t=[];for(let r of n){let o=0;for(let a of t){Math.abs(r)<Math.abs(a)&&([r,a]=[a,r]);let c=r+a,l=a-(c-r);l!==0&&(t[o++]=l),r=c}t.length=o,t.push(r)}let e=t.length-1,i=t[e]??0,s=0;for(;e>0&&s===0;){let r=i,o=t[--e];i=r+o,s=o-(i-r)}if(e>0&&Math.sign(s)===Math.sign(t[e-1])&&s!==0){let r=s*2,o=i+r;r===o-i&&(i=o)}return i}function Fr(n,t){let[e,i]=Cs(n,n),[s,r]=Cs(t,t),o=Math.max(e,s)+Math.min(e,s),a=Math.min(e,s)-(o-Math.max(e,s))+i+r,c=Math.sqrt(o);if(!(c>0))return c;let[l,h]=Cs(c,c);return c+(o-l-h+a)/(2*c)}var[Z0,J0]=[.017453292519943295,29486522708701687e-35],[K0,j0,Q0]=[-.16666666666666632,.00833333333332249,-.0001984126982985795],[t_,e_,n_]=[27557313707070068e-22,-25050760253406863e-24,158969099521155e-24],[i_,s_,r_]=[.0416666666666666,-.001388888888887411,2480158728947673e-20],[o_,a_,l_]=[-27557314351390663e-23,2087572321298175e-24,-11359647557788195e-27];function Qi(n){let t=n%360,e=Math.floor(t/90+.5),i=t-90*e,[s,r]=Cs(i,Z0),o=r+i*J0,a=s*s,c=a*a,l=a*s,h=j0+a*(Q0+a*t_)+a*c*(e_+a*n_),u=s-(a*(.5*o-l*h)-o-l*K0);h=a*(i_+a*(s_+a*r_))+c*c*(o_+a*(a_+a*l_));let f=.5*a;c=1-f;let d=c+(1-c-f+(a*h-s*o));return[[d,u],[0-u,d],[0-d,0-u],[u,0-d]][(e%4+4)%4]}var ii=[0,0,1],Jf=8,c_=4e-15,h_=.01,u_=4096,pe=(n,t)=>n[0]*t[0]+n[1]*t[1]+n[2]*t[2],Ri=(n,t)=>[n[1]*t[2]-n[2]*t[1],n[2]*t[0]-n[0]*t[2],n[0]*t[1]-n[1]*t[0]],si=(n,t)=>[n[0]-t[0],n[1]-t[1],n[2]-t[2]];function nh(n,t){let e=pe(n,t);return[n[0]-e*t[0],n[1]-e*t[1],n[2]-e*t[2]]}function Kf(n){let t=Math.max(Math.abs(n[0]),Math.abs(n[1]),Math.abs(n[2])),[e,i,s]=[n[0]/t,n[1]/t,n[2]/t],r=Math.sqrt(e*e+i*i+s*s);return[e/r,i/r,s/r]}var eh=n=>Zf([-1,...n.flatMap(t=>Cs(t,t))]),na=new Map;function ze(n){let t=`${n[0]} ${n[1]} ${n[2]} ${Object.is(n[0],-0)}${Object.is(n[1],-0)}${Object.is(n[2],-0)}`,e=na.get(t);return e===void 0&&(na.size>=u_&&na.clear(),e=f_(n),na.set(t,e)),e}function f_(n){let t=Kf(n),e=t,i=Math.abs(eh(t));if(i===0)return t;let s=-1;for(let r=0;r<3;r++)Math.abs(t[r])>h_&&(s<0||Math.abs(t[r])<Math.abs(t[s]))&&(s=r);for(let r=0;r<3;r++){if(r===s||t[r]===0)continue;let o=Yf(t[r]);for(let a=-Jf;a<=Jf;a++){let c=[...t];c[r]+=a*o,c[s]-=eh(c)/(2*t[s]);let l=Math.abs(eh(c));Math.abs(c[s]-t[s])<=c_&&l<i&&(e=c,i=l)}}return e}function Pi(n){let t=Kf(nh(Math.abs(n[0])>.999999999?[0,1,0]:[1,0,0],n));return[t,Ri(n,t)]}var cn=n=>Math.abs(n[0])+Math.abs(n[1])+Math.abs(n[2]);function Br(n,{v:t,w:e},i){let[s,r]=[pe(t,i),Ri(e,i)];return[t[0]-s*i[0]-n*r[0],t[1]-s*i[1]-n*r[1],t[2]-s*i[2]-n*r[2]]}var Rs=(n,t,e)=>Math.max(...Br(n.radius,t,e).map(Math.abs))>1e-9*(cn(t.v)+n.radius*cn(t.w)),ia=(n,t)=>Rs(n,t,ii),Ps=(n,{v:t,w:e})=>n.mass*pe(t,t)/2+n.kappa*n.mass*n.radius**2*pe(e,e)/2;var ri=(n,t)=>[n[t],n[t+1],n[t+2]];function d_(n,t,e){let i=n.memory.take(48),s=e.last==="stiffness_ratio"?t.stiffness:t.beta;n.exports[e.function](...t.v,...t.w,...t.n,t.radius,t.kappa,t.e,t.mu,s,i);let r=n.memory.numbers(i,6);return{v:ri(r,0),w:ri(r,3)}}function p_(n,t,e){if(t.floor===null)return null;let{memory:i,layout:s}=n,r=[...e.v,...e.w,...t.n,t.radius,t.kappa,t.floor.e,t.floor.mu,t.floor.beta,t.g,t.height],[o,a]=[i.put(r),i.take(168)];n.call("second_impact",0,o,r.length,a,21);let c=i.numbers(a,21);return{duration:c[0],height:c[1],distance:c[2],after:{v:ri(c,3),w:ri(c,6)},required:c[12],regime:s.regimes[c[13]],rolling:{v:ri(c,14),w:ri(c,17)},why:c[20]}}function Qf(n,t){let e=si(t.v,n.v),i=[e[0]*n.mass,e[1]*n.mass,e[2]*n.mass],s=pe(i,n.n),r=[i[0]-s*n.n[0],i[1]-s*n.n[1],i[2]-s*n.n[2]];return s>0?Math.sqrt(pe(r,r))/s:0}function td(n,t,e){let i=p_(n,t,e);return{afterWall:e,final:i===null?e:i.rolling,required:Qf(t,e),requiredFloor:i===null?0:i.required,why:i===null?"":n.layout.reasons[i.why],steps:i,impact:null}}function jf(n,t,e){let{memory:i,layout:s}=n,r=t.floor??{e:0,mu:0,beta:0},o=t.floor===null?1:t.height,a=[...t.v,...t.w,...t.n,t.radius,t.kappa,t.e,t.mu,t.beta,r.e,r.mu,r.beta,o,Number(e)],[c,l]=[i.put(a),i.take(112)];n.call("first_impact",0,c,a.length,l,14);let h=i.numbers(l,14),[u,f,d]=ri(h,9),g=[u*t.mass,f*t.mass,d*t.mass],_=g[2]>0?Math.hypot(g[0],g[1])/g[2]:0,m=td(n,t,{v:ri(h,0),w:ri(h,3)}),p=Number.isNaN(m.requiredFloor)?0:m.requiredFloor;return{...m,required:h[12],requiredFloor:Math.max(p,_>=s.limits.least_firm/2?1/0:_),impact:{regime:s.regimes[h[13]],required:h[12],floorImpulse:g}}}function ed(n,t,e){let{responses:i}=n.layout;if(e.response===i["two-step"])return jf(n,t,t.together);if(e.name==="two-step-after")return jf(n,t,!1);let s=d_(n,t,e),r={afterWall:s,final:s,why:"",steps:null,impact:null};if(e.response===i.mirror)return{...r,required:0,requiredFloor:0};if(e.response===i.rolling){let o=Rs(t,{v:t.v,w:t.w},t.n)?1:0;return{...r,required:o,requiredFloor:o}}return e.ignores_floor?{...r,required:Qf(t,s),requiredFloor:0}:td(n,t,s)}var Ce={face:0,over:1,line:2,point:3,rim:4},nn=(n,t,e)=>({kind:n,p:t,d:ii,R:0,side:1,u:[1,0,0],lo1:-1/0,hi1:1/0,lo2:-1/0,hi2:1/0,...e}),ts=(n,t)=>nn(Ce.face,n,{d:t,u:Pi(t)[0]}),es=(n,t,e=-1/0,i=1/0,s=0,r=1)=>nn(Ce.line,n,{d:t,R:s,side:r,u:Pi(t)[0],lo1:-1,hi1:1,lo2:e,hi2:i}),ih=(n,t,e)=>es([n[0],n[1],0],ii,t,e),ra=n=>nn(Ce.point,n),sh=(n,t,e)=>nn(Ce.face,n,{d:t,R:e,u:Pi(t)[0]}),oa=(n,t,e,i,s=-1)=>nn(Ce.rim,n,{d:t,R:e,u:i??Pi(t)[0],lo1:s});function sa(n,t,e,i,s){let[r,o]=ze([e[0]-t[0],e[1]-t[1],0]),a=Fr(t[0]-e[0],t[1]-e[1]);return nn(n,[t[0],t[1],0],{d:[o,-r,0],u:[r,o,0],lo1:0,hi1:a,lo2:i,hi2:s})}function aa(n,t){let e=[n,t].filter(Number.isFinite).sort((i,s)=>i-s);return e.length===2&&e[0]===e[1]?[e[0]]:e}function la(n,t,e,i,s=!1){let o=(t?[...n.slice(1),n[0]]:n.slice(1)).map((l,h)=>[n[h],l]),a=aa(e,i),c=[];for(let[l,h]of o){e<i&&(c.push(sa(Ce.face,h,l,e,i)),s||c.push(sa(Ce.face,l,h,e,i)));let u=ze([h[0]-l[0],h[1]-l[1],0]),f=Fr(l[0]-h[0],l[1]-h[1]);for(let d of a)c.push(es([l[0],l[1],d],u,0,f))}if(!s)for(let l of n){e<i&&c.push(ih(l,e,i));for(let h of a)c.push(ra([l[0],l[1],h]))}if(Number.isFinite(i))for(let[l,h]of o)c.push(sa(Ce.over,h,l,i,1/0)),t||c.push(sa(Ce.over,l,h,i,1/0));return c}var ca=1e-12;function nd(n,t){let{point:e,width:i}=n;return[e[0]+i*t[0],e[1]+i*t[1],e[2]+i*t[2]]}function id(n,t){let[e,i]=Pi(ze(n.axis)),[s,r]=Qi(t);return[s*e[0]+r*i[0],s*e[1]+r*i[1],s*e[2]+r*i[2]]}function ha(n){let t=n.size,e=n.center,i=n.corner??[e[0]-t[0]/2,e[1]-t[1]/2,e[2]-t[2]/2];return[i,[i[0]+t[0],i[1]+t[1],i[2]+t[2]]]}var kr=[[1,0,0],[0,1,0],[0,0,1]];function m_(n){let t=ha(n),e=[];for(let i=0;i<3;i++)for(let s of[0,1]){let[r,o]=[(i+1)%3,(i+2)%3],a=s===1!==n.inside?1:-1,c=[a*kr[i][0],a*kr[i][1],a*kr[i][2]];if(n.inside){e.push(ts(t[s],c));continue}let l=[...t[0]];l[i]=t[s][i];let[h,u]=a>0?[0,n.size[o]]:[-n.size[o],0];e.push(nn(Ce.face,l,{d:c,u:kr[r],lo1:0,hi1:n.size[r],lo2:h,hi2:u}))}if(n.inside)return e;for(let i=0;i<3;i++){let[s,r]=[(i+1)%3,(i+2)%3];for(let o of[0,1])for(let a of[0,1]){let c=[...t[0]];c[s]=t[o][s],c[r]=t[a][r],e.push(es(c,kr[i],0,n.size[i]))}}for(let i of[0,1])for(let s of[0,1])for(let r of[0,1])e.push(ra([t[i][0],t[s][1],t[r][2]]));return e}function g_(n){let[[t,e],i,s]=[n.center,n.length/2,n.width/2];return[[t-i,e-s],[t+i,e-s],[t+i,e+s],[t-i,e+s]]}function __(n){let t=n.points;if(!n.closed)return t;let e=0;return t.forEach(([i,s],r)=>{let[o,a]=t[(r+1)%t.length];e+=i*a-s*o}),e<0?[...t].reverse():t}function oh(n){let[t,e,i]=[n.point,ze(n.axis),ie(n.length)];return[t[0]+i*e[0],t[1]+i*e[1],t[2]+i*e[2]]}function x_(n){let[t,e,i,s]=[n.point,ze(n.axis),n.radius,ie(n.length)];if(!(s<1/0))return[es(t,e,-1/0,1/0,i,n.inside?-1:1)];let r=(n.inside?[-1,1]:[1]).map(o=>es(t,e,0,s,i,o));return n.inside||r.push(sh(t,[-e[0],-e[1],-e[2]],i),sh(oh(n),e,i)),[...r,oa(t,e,i),oa(oh(n),e,i)]}function y_(n,t){let[e,i]=[si(t,n.point),ze(n.axis)],s=nh(e,i),r=Math.sqrt(pe(s,s));if(ie(n.length)<1/0){let o=pe(e,i);return!n.inside&&r<n.radius&&0<o&&o<ie(n.length)}return n.inside?r>n.radius:r<n.radius}var ua=n=>n.to_angle-n.from_angle>=360;function v_(n){let[t,e,i]=[ie(n.low),ie(n.height),n.to_angle-n.from_angle],s=[...Qi(n.from_angle+i/2),0],r=ua(n)?-1:Qi(i/2)[0],[o,a]=n.center,c=n.radius,l=(u,f,d,g)=>nn(u,[o,a,0],{R:c,side:f,u:s,lo1:r,hi1:1,lo2:d,hi2:g}),h=t<e?[-1,1].map(u=>l(Ce.line,u,t,e)):[];for(let u of aa(t,e))h.push(oa([o,a,u],ii,c,s,r));if(!ua(n))for(let u of[n.from_angle,n.to_angle]){let[f,d]=Qi(u),g=[o+c*f,a+c*d];t<e&&h.push(ih(g,t,e));for(let _ of aa(t,e))h.push(ra([...g,_]))}if(Number.isFinite(e))for(let u of ua(n)?[-1]:[-1,1])h.push(l(Ce.over,u,e,1/0));return h}function b_(n){let[t,e,i]=[Qi(n.angle),n.length/2,n.radius],s=[-t[1],t[0]],r=(a,c)=>[n.center[0]+a*t[0]+c*s[0],n.center[1]+a*t[1]+c*s[1],0],o=[];for(let a of[1,-1]){let c=[a*t[0],a*t[1],0];o.push(nn(Ce.face,r(0,-a*i),{d:[-c[1],c[0],0],u:c,lo1:-e,hi1:e})),o.push(nn(Ce.line,r(a*e,0),{R:i,side:-1,u:c,lo1:0,hi1:1}))}return o}var rh=(n,t)=>ie(n.low)<=t&&t<=ie(n.height),sd=n=>Math.abs(ze(n)[2])<ca,Is={plane:{features:n=>[ts(n.point,ze(n.normal))],blocked:(n,t)=>pe(si(t,n.point),n.normal)<0,vertical:n=>sd(n.normal)},strip:{features:n=>{let t=ze(n.normal);return[ts(n.point,t),ts(nd(n,t),[-t[0],-t[1],-t[2]])]},blocked:(n,t)=>{let e=ze(n.normal);return pe(si(t,n.point),e)<0||pe(si(t,nd(n,e)),e)>0},vertical:n=>sd(n.normal)},wedge:{features:n=>{let t=ze(n.axis),[e,i]=[id(n,n.from_angle),id(n,n.to_angle)];return n.to_angle-n.from_angle<=180?[ts(n.apex,Ri(t,e)),ts(n.apex,Ri(i,t))]:[nn(Ce.face,n.apex,{d:Ri(t,e),u:e,lo1:0}),nn(Ce.face,n.apex,{d:Ri(i,t),u:i,lo1:0}),es(n.apex,t)]},blocked:(n,t)=>{let e=si(t,n.apex),[i,s]=Pi(ze(n.axis)),r=Math.atan2(pe(e,s),pe(e,i))*180/Math.PI-n.from_angle;return r-360*Math.floor(r/360)>n.to_angle-n.from_angle},vertical:n=>Math.abs(ze(n.axis)[2])>1-ca},box:{features:m_,blocked:(n,t)=>{let[e,i]=ha(n);return[0,1,2].every(s=>e[s]<t[s]&&t[s]<i[s])!==n.inside},vertical:(n,t)=>ha(n)[0][2]<=t&&t<=ha(n)[1][2]},segment:{features:n=>la([n.start,n.end],!1,ie(n.low),ie(n.height)),blocked:()=>!1,vertical:rh},polygon:{features:n=>la(__(n),n.closed,ie(n.low),ie(n.height)),blocked:()=>!1,vertical:rh,encloses:n=>n.closed},table:{features:n=>la(g_(n),!0,n.nose_height??-1/0,ie(n.height),!0),blocked:(n,t)=>Math.abs(t[0]-n.center[0])>n.length/2||Math.abs(t[1]-n.center[1])>n.width/2,vertical:(n,t)=>(n.nose_height===null||n.nose_height<=t)&&t<=ie(n.height),encloses:()=>!0,room:n=>Math.min(n.length,n.width)/2},cylinder:{features:x_,blocked:y_,vertical:(n,t)=>{let e=ie(n.length)<1/0?[n.point[2],oh(n)[2]]:[-1/0,1/0];return Math.abs(ze(n.axis)[2])>1-ca&&Math.min(...e)<=t&&t<=Math.max(...e)},room:n=>n.inside&&!(ie(n.length)<1/0)?n.radius:1/0},sphere:{features:n=>[nn(Ce.point,n.center,{R:n.radius,side:n.inside?-1:1})],blocked:(n,t)=>{let e=si(t,n.center),i=Math.sqrt(pe(e,e));return n.inside?i>n.radius:i<n.radius},vertical:(n,t)=>Math.abs(t-n.center[2])<ca*n.radius,room:n=>n.inside?n.radius:1/0},arc:{features:v_,blocked:()=>!1,vertical:rh,encloses:ua},stadium:{features:b_,blocked:(n,t)=>{let[[e,i],s,r]=[Qi(n.angle),t[0]-n.center[0],t[1]-n.center[1]],[o,a]=[s*e+r*i,r*e-s*i];return Fr(Math.max(Math.abs(o)-n.length/2,0),a)>n.radius},vertical:()=>!0,room:n=>n.radius}};var M_={solid:2/5,hollow:2/3},zr=n=>typeof n.inertia=="string"?M_[n.inertia]:n.inertia;function S_(n){let[t,e]=n.velocity;return n.rolling?[-e/n.radius,t/n.radius,n.spin_z??0]:n.spin??[0,0,0]}function ah(n,t,e){let i=t.law??n.run.law,s=e.laws.find(r=>r.name===i);if(s===void 0)throw new Error(`law: expected one of ${e.laws.map(r=>r.name).join(", ")}, got ${i}`);return s}function w_(n,t){let e=n??{form:"constant",value:1},i=t.forms[e.form==="han-2005"?"polynomial":e.form];switch(e.form){case"constant":return[i,[e.value,0,0]];case"polynomial":return[i,e.coefficients];case"han-2005":return[i,t.han2005];case"power":return[i,[e.at_rest,e.speed,e.exponent]];case"viscoelastic":return[i,[e.c,0,0]];case"exponential":return[i,[e.at_rest,e.at_speed,e.speed]];default:throw new Error(`restitution: expected one of ${Object.keys(t.forms).join(", ")}, got ${e.form}`)}}function Ls(n,t){let[e,i]=w_(n.restitution,t);return{form:e,p:i,mu:n.friction===null?1/0:ie(n.friction),beta:n.tangential_restitution}}var rd=(n,t)=>Object.fromEntries(Object.entries(t).map(([e,i])=>[`${n}_${e}`,i]));function E_(n,t,e){let i=Ls(n,e);if(t.response===e.responses.contact){let{restitution:s,friction:r,tangential_restitution:o}=t.pinned;s!==void 0&&([i.form,i.p]=[e.forms.constant,[ie(s),0,0]]),r!==void 0&&(i.mu=ie(r)),o!==void 0&&(i.beta=ie(o))}return t.last==="stiffness_ratio"&&(i.beta=n.stiffness_ratio),i}function Ns(n,t,e){let i=n.floor,s={force:n.gravity,...i&&{floor:1,g:-n.gravity[2],...rd("floor",Ls(i,t))},...i&&{resistance:i.rolling_resistance,spin_friction:i.spin_friction},...rd("pair",Ls(n.ball_contact,t)),together:n.run.floor_contact==="with"},r=n.walls.map(l=>ah(n,l,t)),o=[...new Set(r.filter(l=>l.response===t.responses.called))],a=n.walls.flatMap((l,h)=>{let u=r[h],{form:f,p:d,mu:g,beta:_}=E_(l,u,t),m=u.response+(u.response===t.responses.called?o.indexOf(u):0),p=Is[l.shape],y={wall:h,form:f,e:d,mu:g,beta:_,law:m,ends:p.encloses?.(l)??!1};return p.features(l).map(b=>({...b,...y,at:b.kind===t.features.rim?e:0}))}),c=n.balls.map(l=>({radius:l.radius,mass:l.mass,kappa:zr(l),x:fa(n,l),v:l.velocity,w:S_(l)}));return{world:s,features:a,balls:c,called:o}}function fa(n,t){let[e,i,s]=t.position;return[e,i,s??(n.floor?t.radius:0)]}function oe(n,t){if(!Number.isFinite(n))return Number.isNaN(n)?"nan":n>0?"inf":"-inf";if(n===0)return Object.is(n,-0)?"-0":"0";let[e,i]=n.toExponential(t-1).split("e"),s=Number(i),r=o=>o.includes(".")?o.replace(/\.?0+$/,""):o;return s<-4||s>=t?`${r(e)}e${s<0?"-":"+"}${String(Math.abs(s)).padStart(2,"0")}`:r(n.toFixed(Math.max(t-1-s,0)))}var Ds=(n,t)=>`(${Array.from(n,e=>oe(e,t)).join(", ")})`;function Gn(n,t=3){if(Number.isNaN(n))return"\u2013";if(!Number.isFinite(n))return n>0?"\u221E":"\u2212\u221E";let e=Math.abs(n);if(n!==0&&!(e>=.001&&e<1e4))return oe(n,t);let i=n===0?t:Math.max(0,t-1-Math.floor(Math.log10(e))),s=n.toFixed(i);return s.includes(".")?s.replace(/\.?0+$/,""):s}function Hn(n,t=3){let e=Math.abs(n);return e>=1?`${Gn(n,t)} m`:e>=.001?`${Gn(n*1e3,t)} mm`:`${Gn(n*1e6,t)} \xB5m`}var od=n=>n>=1?`${Gn(n)} s`:`${Gn(n*1e3)} ms`;var A_=2e3,T_=2e3,C_=256,R_=128,P_=4096;function lh(n,t,e){let{memory:i,layout:s}=n,{records:r,run:o}=s;i.clear();let a=Ns(t,s,n.address("rim")),c=a.balls.length,l=i.records(r.world,[a.world]),h=i.records(r.features,a.features),u=i.records(r.balls,a.balls),f=i.take(8*Math.max(a.called.length,1));a.called.forEach((R,L)=>i.putWhole(f+8*L,n.address(R.function)));let d=i.take(64),g=e.until??t.run.duration??1/0,_=Math.min(e.events??A_,t.run.max_events??1/0),m=performance.now()+(e.milliseconds??T_),p=[],[y,b,v,A,E,x]=[-1,0,o.full,-1,0,R_+c];for(;v===o.full;){let R=i.take(x*r.log.bytes),L=Math.min(_-b,C_);n.call("run",d,l,1,h,a.features.length,u,c,R,x,y,g,L,f,a.called.length,o.all);let I=i.words.subarray(d/4);v=I[0],b+=I[2],A=I[6],[y,E]=i.numbers(d+32,2),p.push({at:R,rows:I[4]}),x=Math.min(4*x,P_),v===o.limit&&b<_&&performance.now()<m&&(v=o.full)}let D={[o.done]:"done",[o.quiet]:"quiet",[o.limit]:b<_?"time":"limit"}[v]??"refused";return{world:l,features:h,balls:u,logs:p,status:D,code:v,end:D==="done"&&g<1/0?g:E,atFault:A}}function ad(n,t,e){let{world:i,balls:s,logs:r,status:o,code:a,end:c,atFault:l}=lh(n,t,e),h=I_(n,r),u=t.balls.map(()=>[]);for(let d of h)u[d.ball].push(d);let f=n.layout.records.balls.bytes;return{status:o,why:o==="refused"?O_(n,t,a,s,l):"",until:c,events:h.slice(u.length),final:U_(n,i,s,u,c),balls:u.map((d,g)=>({pieces:L_(n,i,s+g*f,d,c)}))}}function I_(n,t){let{layout:e,memory:i}=n,{kinds:s,phases:r,regimes:o,records:a}=e,l=Object.fromEntries(["t","kind","ball","met","other","x","v_before","w_before","v","w","phase_before","phase","impulse","floor_impulse","required","regime"].map(u=>[u,i.field(a.log,u)])),h=[];for(let u of t)for(let f=0;f<u.rows;f++){let d=u.at+f*a.log.bytes,g=r[l.phase(d)],_=s[l.kind(d)],m=s[l.met(d)],p=l.regime(d);h.push({t:l.t(d),kind:_==="phase"?g:_,ball:l.ball(d),met:m==="nothing"?null:m,other:l.other(d),x:l.x(d),v_before:l.v_before(d),w_before:l.w_before(d),v:l.v(d),w:l.w(d),phase_before:r[l.phase_before(d)],phase:g,impulse:l.impulse(d),floor_impulse:l.floor_impulse(d),required:l.required(d),regime:p<0?null:o[p]})}return h}function ld(n,t,e){let{memory:i,layout:s}=n,r=s.records.balls,o=i.take(r.bytes*Math.max(e.length,1)),a=r.bytes/8,[c,l,h,u]=["x","v","w","clock"].map(m=>r.fields[m].at/8),f=r.fields.phase.at,d=new Map(s.phases.map((m,p)=>[m,p])),g=i.doubles,_=o/8;for(let m of e){g.copyWithin(_,t/8,t/8+a);for(let p=0;p<3;p++)g[_+c+p]=m.x[p],g[_+l+p]=m.v[p],g[_+h+p]=m.w[p];g[_+u]=0,i.putWhole(8*_+f,d.get(m.phase)??0),_+=a}return o}var cd=n=>n==="held"||n==="left";function L_(n,t,e,i,s){let{memory:r,layout:o}=n,a=o.records.balls,c=ld(n,e,i);n.call("begin",0,t,1,c,i.length);let[l,h]=[r.field(a,"acc"),r.field(a,"turn")],u=[];return i.forEach((f,d)=>{let g=i[d+1],_=(g?.t??s)-f.t;if(!(_>0)&&g!==void 0)return;let m=c+d*a.bytes,p={t:f.t,lasts:_,x:f.x,v:f.v,w:f.w,acc:l(m),turn:h(m),phase:f.phase};cd(f.phase)&&Object.assign(p,{v:[0,0,0],acc:[0,0,0],turn:[0,0,0]}),f.phase==="bouncing"&&Object.assign(p,D_(n,t,m,_,f.x)),u.push(...N_(p))}),u}function N_(n){let{t,lasts:e,x:i,v:s,w:r,acc:o,turn:a}=n,c=-r[2]/a[2];if(!(c>0&&c<e))return[n];let l=(d,g,_=[0,0,0])=>[d[0]+g[0]*c+_[0]*c*c/2,d[1]+g[1]*c+_[1]*c*c/2,d[2]+g[2]*c+_[2]*c*c/2],[h,u]=l(r,a),f={...n,t:t+c,lasts:e-c,x:l(i,s,o),v:l(s,o)};return[{...n,lasts:c},{...f,w:[h,u,0],turn:[a[0],a[1],0]}]}function D_(n,t,e,i,s){let{memory:r,layout:o}=n;if(!(i>0))return{v:[0,0,0],acc:[0,0,0]};n.call("states",0,t,1,e,1,r.put([i]),1);let a=r.field(o.records.balls,"x")(e);return{v:[(a[0]-s[0])/i,(a[1]-s[1])/i,0],acc:[0,0,0]}}function U_(n,t,e,i,s){let{memory:r,layout:o}=n,a=o.records.balls;return i.map((c,l)=>{let h=c[c.length-1];if(cd(h.phase))return{x:h.x,v:h.v,w:h.w,phase:h.phase};let u=ld(n,e+l*a.bytes,[h]);n.call("states",0,t,1,u,1,r.put([s-h.t]),1);let[f,d,g]=["x","v","w"].map(_=>r.field(a,_)(u));return{x:f,v:d,w:g,phase:h.phase}})}function O_(n,t,e,i,s){let{memory:r,layout:o}=n,a=i+s*o.records.balls.bytes,[c,l]=["clock","x"].map(u=>r.field(o.records.balls,u)(a));return`${t.balls[s].name??`ball ${s}`}: expected an event that its law has an answer for, got one at t = ${oe(c,6)} s, x = ${Ds(l,4)}: ${o.refusals[e]}`}function Vr(n,t){let{memory:e,layout:i}=n,{logs:s}=lh(n,t,{events:500}),r=i.records.log,o=s.flatMap(j=>Array.from({length:j.rows},(X,Y)=>j.at+Y*r.bytes)),[a,c,l]=["kind","ball","other"].map(j=>e.field(r,j)),h=o.find(j=>c(j)===0&&i.kinds[a(j)]==="wall"),u=t.balls[0].name??"the first ball";if(h===void 0)throw new Error(`compare: expected a scene in which ${u} meets a wall, got one in which it meets none`);let[f,d,g,_]=["t","x","v_before","w_before"].map(j=>e.field(r,j)(h)),m=l(h),p={...t,run:{...t.run,law:"two-step"},walls:t.walls.map(j=>({...j,law:null}))},y=Ns(p,i,0);e.clear();let b=e.records(i.records.features,y.features),v=e.records(i.records.balls,[{...y.balls[0],x:d,v:g,w:_}]),A=e.take(8*y.features.length);n.call("gaps",0,b,y.features.length,v,1,A,1,y.features.length);let E=-1;e.numbers(A,y.features.length).forEach((j,X)=>{let Y=E<0||Math.abs(j)<Math.abs(e.doubles[A/8+E]);y.features[X].wall===m&&Number.isFinite(j)&&Y&&(E=X)});let x=e.take(40);n.call("meet",0,b+E*i.records.features.bytes,1,v,1,x,5);let[w,D,R,L,I]=e.numbers(x,5),[z,{radius:C,mass:H}]=[t.walls[m],t.balls[0]],{mu:q,beta:V}=Ls(z,i);return{t:f,wall:m,radius:C,mass:H,kappa:Number(y.balls[0].kappa),v:g,w:_,n:[w,D,R],e:I,mu:q,beta:V,stiffness:z.stiffness_ratio,floor:t.floor&&F_(n,t.floor,L),g:t.floor?-t.gravity[2]:0,height:t.floor?Math.max(d[2]-C,0):1/0,together:t.run.floor_contact==="with"}}function F_(n,t,e){let{form:i,p:s,mu:r,beta:o}=Ls(t,n.layout),[a,c]=[n.memory.put([i,...s,Math.max(e,0)]),n.memory.take(8)];return n.call("restitution",0,a,5,c,1),{e:n.memory.numbers(c,1)[0],mu:r,beta:o}}var B_=1e-100;function k_({v:n,w:t,n:e}){let i=pe(n,e)<=1e-12*cn(n)?[]:["a ball that moves towards the wall"],s=Math.max(...[...n,...t].map(Math.abs));return s!==0&&s<B_&&i.push("a ball at rest, or a component of velocity or spin of at least 1e-100"),i}function z_(n){let t=[];return(!(n.floor!==null&&n.v[2]===0&&n.height===0)||ia(n,n))&&t.push("hypothesis 1: a ball that rolls on the floor without sliding"),Math.abs(n.n[2])<1e-12||t.push("hypothesis 1: a vertical wall (any other lifts the ball or presses it down)"),n.e!==1&&t.push("hypothesis 3: a wall of restitution 1 (with less, energy would have to be created)"),t}function V_(n){if(n.floor===null||!n.together||n.beta===0||n.beta===-1)return[];let t=Br(n.radius,n,n.n),e=n.n[2]<0||t[2]>0&&Math.min(n.mu,1e300)*t[2]>n.n[2]*Math.sqrt(pe(t,t));return n.height===0&&n.v[2]<=0&&(e||n.v[2]<0)?["tangential restitution 0 where the wall presses the ball on the floor"]:[]}function G_(n,t,e){let[i,s]=e.chi_range??[0,1/0],r=(1+1/n.kappa)/2,o=n.stiffness*r;return i<=o&&o<=s?[]:[`a stiffness ratio from ${oe(i/r,3)} to ${oe(s/r,3)}, for which the law is tabulated`]}function H_(n,{limits:t}){let[e,i]=t.stiffness,s=[];return e<=n.stiffness&&n.stiffness<=i||s.push(`a stiffness ratio from ${oe(e,6)} to ${oe(i,6)}`),Math.sqrt(n.stiffness*(1+1/n.kappa))<=t.most_omega||s.push(`a stiffness ratio k and an inertia kappa with k (1 + 1/kappa) at most ${oe(t.most_omega**2,6)}`),s}var W_={conventional:z_,"two-step":V_,maw:G_,stronge:H_},fd=(n,t,e)=>[...k_(n,e,t),...W_[t.name]?.(n,e,t)??[]],hd=n=>n!==null&&n.mu>0&&n.beta>-1;function ch(n,{afterWall:t}){return n.floor!==null&&n.height===0&&t.v[2]<-1e-9*cn(n.v)?["it drives the ball into the floor and ignores the simultaneous reaction of the floor"]:[]}function dd(n,{afterWall:t}){let e=[],[i,s]=[Ps(n,n),Ps(n,t)];return s>i*(1+1e-9)&&e.push(`it creates energy: ${oe(100*s/i,4)} % is left after the wall`),pe(t.v,n.n)<-1e-9*cn(n.v)&&e.push("it sends the ball through the wall"),e}function X_(n,t){let e=ch(n,t);return hd(n)&&Rs(n,n,n.n)&&e.push("the ball slips on the wall, and this wall has friction: the tangential impulse is ignored"),hd(n.floor)&&ia(n,t.afterWall)&&e.push("the ball leaves the wall sliding on a floor with friction, which bends its path"),e}var $_=(n,t)=>t.requiredFloor>0?["it reverses the slip at the wall, whereas friction can only stop it: the wall would have to pull the ball down and the floor would need a friction above 1, whatever the impulses"]:[];function q_(n,t){let e=n.e!==1?[`it assumes restitution 1; this wall has ${oe(n.e,6)}`]:[];return Rs(n,n,n.n)&&(n.beta<1&&e.push(`it assumes tangential restitution 1, which reverses the slip; this wall has ${oe(n.beta,6)}`),t.required>n.mu&&e.push(`it requires a wall friction of ${oe(t.required,3)}; this wall has ${oe(n.mu,6)}`)),[...dd(n,t),...e,...ch(n,t)]}function ud(n,t){let e=[...dd(n,t),...ch(n,t)];return n.beta!==0&&e.push("it models the tangential rebound by springs and ignores this wall's tangential restitution"),e}function Y_(n,{afterWall:t}){let e=n.floor!==null&&n.height===0&&n.v[2]===0,i=t.v[2]!==0||ia(n,t);return e&&i?["it ignores the floor on which this ball rests"]:[]}var Z_={mirror:X_,conventional:$_,"no-slip":q_,maw:ud,stronge:ud,contact:Y_},pd=(n,t,e)=>Z_[t.name]?.(n,e)??[];var J_={stick:"sticking",slide:"sliding",graze:"by separation",jam:"jammed",stall:"unresolved"};function md(n,t,e){let i=[...K_(n,t),...j_(n,t)];return e===null?[...i,`the ball never rolls again: ${t.why}`]:[...i,...Q_(n,e)]}function K_(n,{impact:t}){return t===null?[]:t.floorImpulse.some(e=>e!==0)?[`the wall presses the ball on the floor: both act at once, and the wall contact ends ${J_[t.regime]}`]:t.regime==="slide"?[`the ball slides on the wall: its friction ${Gn(n.mu)} is below the ${Gn(t.required)} required for sticking`]:t.regime==="graze"?["the ball only grazes the wall, without an impulse"]:[]}function j_(n,{steps:t}){if(t===null)return[];let e=[];if(Number.isFinite(t.duration)&&t.duration>0){let i=t.after.v[2]>0?", and bounces":"",[s,r]=[Hn(t.distance),Hn(t.height)];if(e.push(`the ball flies for ${od(t.duration)}, ${s} far and up to ${r} high${i}`),t.regime==="slide"&&t.why===0){let[o,a]=[Gn(n.floor?.mu??0),Gn(t.required)];e.push(`it lands sliding: the floor's friction ${o} is below the ${a} required for sticking`)}}else t.duration===0&&t.why===0&&Math.max(...Br(n.radius,t.after,ii).map(Math.abs))>1e-9*cn(t.after.v)&&e.push("the ball stays on the floor and slides until it rolls");return e}function Q_(n,t){let[e,i,s]=[n.v,t.v,n.n],r=cn(e)+n.radius*cn(n.w);if(!(Math.abs(i[0])+Math.abs(i[1])>1e-12*r))return["the ball stops at the wall"];let o=[];s[0]*i[0]+s[1]*i[1]<-1e-9*r&&o.push("its spin turns the ball round: it rolls back to the wall and meets it again");let[a,c]=[e,i].map(l=>s[0]*l[1]-s[1]*l[0]);return a*c<0&&Math.abs(c)>1e-12*r?o.push("the ball returns to the side of the normal from which it came"):a===0&&Math.abs(c)>1e-12*r&&o.push(`the ball leaves to the ${c>0?"left":"right"} of the wall's normal`),o}function gd(n,t,e){let i=Math.sqrt(n[0]**2+n[1]**2),[s,r]=[n[0]/i,n[1]/i];return Math.atan2(Math.abs(s*t[1]-r*t[0]),e*(s*t[0]+r*t[1]))*180/Math.PI}function hh(n,t){let e=cn(n.v)+n.radius*cn(n.w);if(!(Math.abs(t.v[0])+Math.abs(t.v[1])>1e-12*e))return null;let i=gd(n.n,t.v,1);return Number.isNaN(i)?null:i}var da=n=>Number.isNaN(n)?null:n,uh=n=>!n.v.some(Number.isNaN);function _d(n,t,e){let i=fd(t,e,n.layout);if(i.length>0)return{answer:null,why:`no prediction: it requires ${i.join("; and ")}`};let s=ed(n,t,e);return uh(s.afterWall)?{answer:s,why:""}:{answer:null,why:`no prediction: ${s.why}`}}function tx(n,t,e){let{answer:i,why:s}=_d(n,t,e),r={law:e.name,angle:null,angle_after_wall:null,velocity:null,spin:null,after_wall:null,energy_kept:null,hop:null,flight:null,required:null,available:t.mu,required_floor:null,available_floor:t.floor?.mu??null};if(i===null)return{...r,admissible:!1,reasons:[s],remarks:[]};let o=pd(t,e,i),a=uh(i.final)?i.final:null,{afterWall:c,steps:l}=i,h=Ps(t,t);return{...r,angle:a&&hh(t,a),angle_after_wall:hh(t,c),velocity:a&&a.v,spin:a&&a.w,after_wall:{velocity:c.v,spin:c.w},energy_kept:a&&h>0?Ps(t,a)/h:null,hop:l&&da(l.height),flight:l&&da(l.distance),required:da(i.required),required_floor:da(i.requiredFloor),admissible:o.length===0,reasons:o,remarks:md(t,i,a)}}function ex(n,t){let e=t.height>0;return n.layout.laws.filter(s=>s.variant_of===""&&(e||!s.ignores_floor)).map(s=>(n.memory.clear(),tx(n,t,s)))}function xd(n,t){let e=Vr(n,t);return{meeting:e,incidence:gd(e.n,e.v,-1),verdicts:ex(n,e)}}function nx(n,t){let{v:e,w:i,n:s}=n,r=Math.atan2(s[0]*e[1]-s[1]*e[0],-(s[0]*e[0]+s[1]*e[1])),a=-((r<0?-1:1)*t*Math.PI/180-r),[c,l]=[Math.cos(a),Math.sin(a)],h=([u,f,d])=>[c*u-l*f,l*u+c*f,d];return{...n,v:h(e),w:h(i)}}function yd(n,t,e,i,s){return i.map(r=>{n.memory.clear();let o=nx(e,r),{answer:a}=_d(n,o,t),c=a&&(s==="wall"?a.afterWall:a.final);return c&&uh(c)?hh(o,c):null})}var pa=class{constructor(t,e){this.memory=t,this.base=Math.ceil(e/16)*16,this.top=this.base,this.doubles=new Float64Array(t.buffer),this.words=new Int32Array(t.buffer)}clear(){this.top=this.base}take(t){let e=this.top;if(this.top=Math.ceil((e+t)/16)*16,this.top>268435456)throw new Error("engine: expected a run that fits into 256 MB, got a larger one; ask for fewer events");let i=this.top-this.memory.buffer.byteLength;return i>0&&this.memory.grow(Math.ceil(i/65536)),this.doubles.buffer!==this.memory.buffer&&(this.doubles=new Float64Array(this.memory.buffer),this.words=new Int32Array(this.memory.buffer)),new Uint8Array(this.memory.buffer,e,this.top-e).fill(0),e}put(t){let e=this.take(8*Math.max(t.length,1));return this.doubles.set(t,e/8),e}numbers(t,e){return Array.from(this.doubles.subarray(t/8,t/8+e))}putWhole(t,e){this.words[t/4]=e,this.words[t/4+1]=e<0?-1:0}records(t,e){let i=this.take(t.bytes*Math.max(e.length,1));return e.forEach((s,r)=>{for(let[o,a]of Object.entries(s))this.set(t,i+r*t.bytes,o,a)}),i}set(t,e,i,s){let r=t.fields[i];typeof s=="object"?this.doubles.set(s,(e+r.at)/8):r.whole?this.putWhole(e+r.at,Number(s)):this.doubles[(e+r.at)/8]=Number(s)}field(t,e){let{at:i,count:s,whole:r}=t.fields[e];return s===1?c=>r?this.words[(c+i)/4]:this.doubles[(c+i)/8]:c=>{let l=(c+i)/8,h=this.doubles;return[h[l],h[l+1],h[l+2]]}}};var fh=class{constructor(t,e){let i=t.exports;this.exports=i,this.layout=e,this.memory=new pa(i.memory,i.__heap_base.value)}call(t,e,...i){this.exports[t](e,...i)}address(t){return this.exports[`address_of_${t}`]()}};async function vd(n,t){if(typeof WebAssembly>"u")throw new Error("expected a browser with WebAssembly, got one without; any browser of the last years has it");let e=new Uint8Array(n),i=await WebAssembly.compile(e).catch(o=>{throw new Error(`engine.wasm: expected carom's module, got one that the browser refuses: ${o.message}`)}),[s]=WebAssembly.Module.customSections(i,"carom"),r=s===void 0?"none":new TextDecoder().decode(s);if(r!==t.version)throw new Error(`engine.wasm: expected the module of version ${t.version}, got version ${r}; build both anew with make wasm`);return new fh(await WebAssembly.instantiate(i),t)}var ix={quiet:"nothing more happens",done:"duration",limit:"max_events",time:"time of computing",refused:"refused"},sx=n=>Number.isFinite(n)?n:null;function bd(n,t){let e=n.walls.map((r,o)=>r.name||`${r.shape} ${o}`),i=n.balls.map((r,o)=>r.name||`ball ${o}`),s=(r,o,a)=>{let{mass:c,radius:l}=n.balls[r];return c*pe(o,o)/2+zr(n.balls[r])*c*(l*l)*pe(a,a)/2};return{events:t.events.map(r=>({t:r.t,kind:r.kind,ball:r.ball,position:r.x,velocity:r.v,spin:r.w,other:r.other,name:r.met==="wall"?e[r.other]:r.met==="ball"?i[r.other]:"",phase:r.phase,impulse:r.impulse,required_friction:sx(r.required),energy_lost:s(r.ball,r.v_before,r.w_before)-s(r.ball,r.v,r.w)})),final:t.final.map(({x:r,v:o,w:a,phase:c},l)=>({position:r,velocity:o,spin:a,phase:c,name:i[l]})),end:t.until,ended:ix[t.status]}}var[rx,ox]=[1e-100,1e100],Md=60,ax={kind:"number",what:"an acceleration in m/s^2"},lx="'solid', 'hollow', or kappa = I/(m a^2) in (0, 2/3]";function cx(n){let t=n==null?"nothing":JSON.stringify(n)??String(n);return t.length>Md?`${t.slice(0,Md-3)}...`:t}var ma=n=>typeof n=="object"&&n!==null&&!Array.isArray(n);function Sd(n,t){let e=ie(n),i=t.least??-1/0,s=t.above?e>i:e>=i,r=Math.abs(e),o=(t.above?r>=rx:!0)&&r<=ox;return s&&e<=(t.most??1/0)&&(o||t.infinite===!0&&r===1/0)}var dh=class{constructor(t){this.layout=t,this.faults=[]}fault(t,e,i){this.faults.push(`${t}: expected ${e}, got ${cx(i)}`)}table(t,e,i){if(!ma(e)){this.fault(t,"a table of fields",e);return}for(let s of Object.keys(e))Object.hasOwn(i,s)||this.fault(t,"a field that is known here",s);for(let[s,r]of Object.entries(i))r.kind!=="part"&&this.field(t===""?s:`${t}.${s}`,e[s],r)}field(t,e,i){if(e==null){i.optional||this.fault(t,i.what??"a value",e);return}let s=["text","law"].includes(i.kind);i.kind==="number"&&!Sd(e,i)?this.fault(t,i.what??"a number",e):i.kind==="vector"||i.kind==="gravity"?this.vector(t,e,i):i.kind==="flag"&&typeof e!="boolean"?this.fault(t,"true or false",e):i.kind==="choice"&&!i.values?.includes(String(e))?this.fault(t,`one of ${i.values?.join(", ")}`,e):i.kind==="whole"&&!(Number.isInteger(e)&&Number(e)>=1)?this.fault(t,"a whole number >= 1",e):s&&typeof e!="string"?this.fault(t,"a text",e):i.kind==="law"&&!this.layout.laws.some(r=>r.name===e)?this.fault(t,`one of ${this.layout.laws.map(r=>r.name).join(", ")}`,e):i.kind==="restitution"?this.restitution(t,e):i.kind==="inertia"&&e!=="solid"&&e!=="hollow"&&(Sd(e,{kind:"number",least:0,most:2/3*(1+1e-12),above:!0})||this.fault(t,lx,e))}vector(t,e,i){let[s,r]=i.counts??[3,3],o=i.each??ax;if(!Array.isArray(e)||e.length<s||e.length>r){this.fault(t,i.what??"3 numbers",e);return}e.forEach((a,c)=>this.field(`${t}[${c}]`,a,o)),i.nonzero&&e.every(a=>a===0)&&this.fault(t,"a direction, not all zero",e)}restitution(t,e){let i=this.layout.fields.restitution,s=ma(e)?e.form:void 0;typeof s=="string"&&Object.hasOwn(i,s)?this.table(t,e,i[s]):this.fault(`${t}.form`,`one of ${Object.keys(i).join(", ")}`,s??e)}};function wd(n,t){let{fields:e}=t,i=new dh(t);if(!ma(n))return i.fault("scene","a table of fields",n),i.faults;i.table("",n,e.scene),n.floor!==null&&i.table("floor",n.floor,e.floor),i.table("ball_contact",n.ball_contact,e.ball_contact),i.table("run",n.run,e.run);let[s,r]=[n.walls,n.balls];return Array.isArray(s)?s.forEach((o,a)=>{let c=ma(o)?o.shape:void 0;typeof c=="string"&&Object.hasOwn(e.walls,c)?i.table(`walls[${a}]`,o,e.walls[c]):i.fault(`walls[${a}].shape`,`one of ${Object.keys(e.walls).join(", ")}`,c)}):i.fault("walls","a list",s),!Array.isArray(r)||r.length===0?i.fault("balls","at least one ball",r):r.forEach((o,a)=>i.table(`balls[${a}]`,o,e.ball)),i.faults}var ga=1e-9,[Ed,Ad]=[100,2e3];function Pd(n,t){let e=wd(t,n.layout);return e.length>0?e:(e.push(...ux(t),...dx(t),...px(t,n.layout)),e.length>0?e:gx(n,t))}var Td=(n,t,e)=>0<t-n&&t-n<=360?[]:[`expected ${e} of more than 0 and at most 360 degrees`];function hx(n){let t=[],[e,i]=[ie(n.low??"-inf"),ie(n.height??"inf")];return n.shape==="wedge"&&t.push(...Td(n.from_angle,n.to_angle,"an opening")),n.shape==="arc"&&t.push(...Td(n.from_angle,n.to_angle,"an arc")),n.shape==="box"&&n.center===null==(n.corner===null)&&t.push("expected either center or corner"),n.shape==="segment"&&String(n.start)===String(n.end)&&t.push("expected another point than start"),n.shape==="cylinder"&&!(ie(n.length)>0)&&t.push("expected a length greater than 0 m"),n.shape==="table"&&!(i>=(n.nose_height??0)&&i>0)&&t.push("expected a height above nose and floor"),"low"in n&&!(e<=i&&e<1/0&&i>-1/0)&&t.push(`expected a height above low = ${oe(e,6)} m`),n.shape==="polygon"&&fx(n.points,n.closed)&&t.push("expected an outline that does not meet itself"),t}function ux(n){let t=n.walls.flatMap((e,i)=>hx(e).map(s=>`walls[${i}]: ${s}`));return n.balls.forEach((e,i)=>{e.rolling&&e.spin!==null&&t.push(`balls[${i}].spin: expected no spin with rolling = true; it follows from the velocity`),e.rolling&&e.velocity[2]&&t.push(`balls[${i}].velocity: expected no speed along z with rolling = true`)}),n.balls.length>Ed&&t.push(`balls: expected at most ${Ed} in a page, got ${n.balls.length}; carom simulate takes more`),t}function fx(n,t){let e=t?n.length:n.length-1,i=Array.from({length:e},(o,a)=>[n[a],n[(a+1)%n.length]]),s=(o,a,c)=>Math.sign((a[0]-o[0])*(c[1]-o[1])-(a[1]-o[1])*(c[0]-o[0])),r=(o,a,c)=>s(o,a,c)===0&&[0,1].every(l=>Math.min(o[l],a[l])<=c[l]&&c[l]<=Math.max(o[l],a[l]));return i.some(([o,a],c)=>String(o)===String(a)||i.slice(c+1).some(([l,h],u)=>{let f=s(o,a,l)*s(o,a,h)<0&&s(l,h,o)*s(l,h,a)<0,d=t&&c===0&&c+1+u===e-1;return f||!d&&(r(o,a,h)||r(l,h,o))}))}function dx(n){let t=[],[e,i,s]=n.gravity;return n.floor&&(e!==0||i!==0||s>0)&&t.push(`gravity: expected gravity along -z, as there is a floor, got ${Ds(n.gravity,6)}`),n.balls.forEach((r,o)=>{let[a,c]=[fa(n,r)[2],r.radius];n.floor&&a<c*(1-ga)?t.push(`balls[${o}].position[2]: expected z of at least the radius, ${oe(c,6)}, got ${oe(a,6)}, which overlaps the floor by ${Hn(c-a)}`):r.rolling&&!n.floor?t.push(`balls[${o}].rolling: expected a floor to roll on, got true in a scene without one`):r.rolling&&a>c*(1+ga)&&t.push(`balls[${o}].position[2]: expected z = radius = ${oe(c,6)}, got ${oe(a,6)} of a ball that rolls`)}),t}function px(n,t){return n.walls.flatMap((e,i)=>mx(n,e,ah(n,e,t),t).map(s=>`walls[${i}].${s}`))}function mx(n,t,e,i){let s=[],r={restitution:"a number from 0 to 1, or a form",friction:"a number >= 0 (inf: never slips)"};for(let o of["restitution","friction"])e.needs.includes(o)&&t[o]===null&&s.push(`${o}: expected ${r[o]}, got nothing; the law ${e.name} reads it`);if(e.last==="stiffness_ratio"){let o=t.stiffness_ratio,[a,c]=e.chi_range??[0,1/0],l=n.balls.map(_=>(1+1/zr(_))/2),[h,u]=[Math.max(...l.map(_=>a/_)),Math.min(...l.map(_=>c/_))];e.chi_range&&!(h<=o&&o<=u)&&s.push(`stiffness_ratio: expected a stiffness ratio from ${oe(h,3)} to ${oe(u,3)}, for which the law ${e.name} is tabulated, got ${oe(o,6)}`);let{stiffness:f,most_omega:d}=i.limits,g=l.every(_=>Math.sqrt(o*2*_)<=d);!e.chi_range&&!(f[0]<=o&&o<=f[1]&&g)&&s.push(`stiffness_ratio: expected a stiffness ratio from ${f[0]} to ${f[1]} for the law ${e.name}, got ${oe(o,6)}`),t.tangential_restitution!==0&&s.push(`tangential_restitution: expected 0 for the law ${e.name}, got ${oe(t.tangential_restitution,6)}`)}if(e.response===i.responses.rolling){let o=t.restitution;o&&!(o.form==="constant"&&o.value===1)&&s.push(`restitution: expected hypothesis 3: a wall of restitution 1, for the law ${e.name}`),n.balls.every(a=>Is[t.shape].vertical(t,a.radius))||s.push(`shape: expected hypothesis 1: a vertical wall, for the law ${e.name}`)}return s}function gx(n,t){let{memory:e,layout:i}=n,s=Ns(t,i,0);if(s.features.length>Ad)return[`walls: expected at most ${Ad} faces, edges and corners in a page, got ${s.features.length}; carom simulate takes more`];let r=_x(t);if(r.length>0)return r;let o=t.balls.map(f=>fa(t,f)),a=t.walls.map((f,d)=>o.map((g,_)=>{let m=Is[f.shape].blocked(f,g);return m&&r.push(`balls[${_}].position: expected a place on the free side of ${Rd(f,d)}, got ${Ds(g,6)}; move the ball`),m}));e.clear();let c=s.features.length,l=e.records(i.records.features,s.features),h=e.records(i.records.balls,s.balls),u=e.take(8*Math.max(c*o.length,1));return n.call("gaps",0,l,c,h,o.length,u,o.length,c),o.forEach((f,d)=>{let g=t.balls[d].radius,[_,m]=[-ga*g,-1];for(let p=0;p<c;p++){let y=e.doubles[u/8+d*c+p];y>=-g&&y<_&&!a[Number(s.features[p].wall)][d]&&([_,m]=[y,p])}if(m>=0){let p=Number(s.features[m].wall);r.push(Cd(d,f,Rd(t.walls[p],p),-_))}for(let p=0;p<d;p++){let y=g+t.balls[p].radius,b=Math.hypot(f[0]-o[p][0],f[1]-o[p][1],f[2]-o[p][2])-y;b<-ga*Math.min(g,t.balls[p].radius)&&r.push(Cd(d,f,`balls[${p}]`,-b))}}),r}var Cd=(n,t,e,i)=>`balls[${n}].position: expected a place where the ball touches nothing, got ${Ds(t,6)}, which overlaps ${e} by ${Hn(i)}; move it by ${Hn(i)} or more`,Rd=(n,t)=>`walls[${t}] (${n.name??`${n.shape} ${t}`})`;function _x(n){let t=n.balls.map(s=>s.radius),[e,i]=[Math.min(...t),Math.max(...t)];return n.walls.flatMap((s,r)=>{let o=Is[s.shape].room?.(s)??1/0;if(i>=o)return[`walls[${r}]: expected room for a ball of radius ${Hn(i)}, got room for radii below ${Hn(o)}`];let a=s.shape==="table"?s.nose_height:null;return a===null||a<2*e?[]:[`walls[${r}].nose_height: expected less than ${Hn(2*e)}, the diameter of a ball, which would roll under it, got ${oe(a,6)}`]})}async function Id(n,t){return new ph(await vd(n,t))}var ph=class{constructor(t){this.module=t,this.version=t.layout.version,this.laws=t.layout.laws}faults(t){return Pd(this.module,t)}run(t,e,i={}){return ad(this.module,this.checked(e===void 0?t:xx(t,e)),i)}report(t,e,i={}){return bd(t,this.run(t,e,i))}checked(t){let e=this.faults(t);if(e.length>0)throw new Error(e.join(`
`));return t}compare(t){return xd(this.module,this.checked(t)).verdicts}meeting(t){return Vr(this.module,this.checked(t))}curve(t,e,i,s="final"){let r=this.laws.find(o=>o.name===t);if(r===void 0)throw new Error(`law: expected one of ${this.laws.map(o=>o.name).join(", ")}, got ${t}`);return yd(this.module,r,Vr(this.module,this.checked(e)),i,s)}},xx=(n,t)=>({...n,run:{...n.run,law:t},walls:n.walls.map(e=>({...e,law:null}))});function Jt(n,t={},...e){let i=document.createElement(n);for(let[s,r]of Object.entries(t))typeof r=="function"?i.addEventListener(s,r):r===!0?i.setAttribute(s,""):r!==!1&&i.setAttribute(s,r);return i.append(...e),i}function Ve(n,t={},...e){let i=document.createElementNS("http://www.w3.org/2000/svg",n);for(let[s,r]of Object.entries(t))i.setAttribute(s,String(r));return i.append(...e),i}function Zt(n){let t=document.getElementById(n);if(!t)throw new Error(`the page has no element ${n}`);return t}function oi(n,t=3){return n==null||Number.isNaN(n)?"\u2013":n===1/0?"\u221E":n===-1/0?"\u2212\u221E":Math.abs(n)<1e-9?"0":(Math.abs(n)>=10**t?n.toFixed(0):String(Number(n.toPrecision(t)))).replace("-","\u2212")}function Ld(n){let t=Math.abs(n);return t<1e-9?"0 mm":t<.001?`${oi(n*1e6)} \xB5m`:t<1?`${oi(n*1e3)} mm`:`${oi(n)} m`}var Gr=n=>n!==0&&Math.abs(n)<.1?`${oi(n*1e3)} ms`:`${n.toFixed(3)} s`;var En=(n,t)=>[n[0]+t[0],n[1]+t[1],n[2]+t[2]];var sn=(n,t)=>[n[0]*t,n[1]*t,n[2]*t],Us=(n,t)=>n[0]*t[0]+n[1]*t[1]+n[2]*t[2],_a=(n,t)=>[n[1]*t[2]-n[2]*t[1],n[2]*t[0]-n[0]*t[2],n[0]*t[1]-n[1]*t[0]],An=n=>Math.hypot(n[0],n[1],n[2]),Ge=n=>{let t=An(n);return t>0?sn(n,1/t):[1,0,0]};var yx=.15,vx=400;function Dd(n,t){let e=0,i=n.length-1;for(;e<i;){let s=e+i+1>>1;n[s].t<=t?e=s:i=s-1}return e}function Hr(n,t){let{x:e,v:i,w:s,acc:r,turn:o}=n;return{x:[e[0]+t*(i[0]+.5*t*r[0]),e[1]+t*(i[1]+.5*t*r[1]),e[2]+t*(i[2]+.5*t*r[2])],v:[i[0]+t*r[0],i[1]+t*r[1],i[2]+t*r[2]],w:[s[0]+t*o[0],s[1]+t*o[1],s[2]+t*o[2]],phase:n.phase}}function ai(n,t){let e=n[Dd(n,t)];return Hr(e,Math.max(0,Math.min(t-e.t,e.lasts)))}function bx(n,t){return[n[0]*t[0]-n[1]*t[1]-n[2]*t[2]-n[3]*t[3],n[0]*t[1]+n[1]*t[0]+n[2]*t[3]-n[3]*t[2],n[0]*t[2]-n[1]*t[3]+n[2]*t[0]+n[3]*t[1],n[0]*t[3]+n[1]*t[2]-n[2]*t[1]+n[3]*t[0]]}function Mx(n,t,e){let i=An(t),s=i*e/2;if(s===0)return n;let r=Math.sin(s)/i;return bx([Math.cos(s),t[0]*r,t[1]*r,t[2]*r],n)}function Nd(n,t,e){let i=An(t.turn)>0,s=Math.max(An(t.w),An(Hr(t,e).w))*e,r=i?Math.min(vx,Math.max(1,Math.ceil(s/yx))):1;for(let o=0;o<r;o++)n=Mx(n,Hr(t,(o+.5)*e/r).w,e/r);return n}var Os=class{constructor(t){this.pieces=t,this.starts=[[1,0,0,0]]}at(t){let{pieces:e,starts:i}=this,s=Dd(e,t);for(;i.length<=s;){let r=e[i.length-1];i.push(Nd(i[i.length-1],r,Math.max(0,e[i.length].t-r.t)))}return Nd(i[s],e[s],Math.max(0,Math.min(t-e[s].t,e[s].lasts)))}};function Sx(n){return n==="flight"||n==="bouncing"||n==="left"?"flight":n==="sliding"?"sliding":"rolling"}var wx={flight:.001,sliding:.02,rolling:.02};function Fs(n,t,e){let i=[];for(let s of n){let r=Math.min(s.lasts,t-s.t);if(!(r>0))continue;let o=Sx(s.phase),{v:a,acc:c}=s,l=An(_a(a,c))<1e-9*An(a)*An(c),h=An(c)*r*r/8,u=l?1:Math.max(1,Math.min(32,Math.ceil(Math.sqrt(h/(wx[o]*e))))),f=i[i.length-1];(!f||f.style!==o)&&i.push(f={style:o,points:[s.x]});let d=l?-Us(a,c)/Us(c,c):0;d>0&&d<r&&f.points.push(Hr(s,d).x);for(let g=1;g<=u;g++)f.points.push(Hr(s,r*g/u).x)}return i}var mh=n=>n==="solid"?2/5:n==="hollow"?2/3:n;function gh(n,t,e){let i=0;return n.balls.forEach((s,r)=>{let{x:o,v:a,w:c}=ai(t.balls[r].pieces,e),l=mh(s.inertia)*s.mass*s.radius**2,h=n.floor?[0,0,o[2]-s.radius]:o;i+=(s.mass*Us(a,a)+l*Us(c,c))/2-s.mass*Us(n.gravity,h)}),i}function Ud(n,t,e,i){let s=new Set([0,e]);for(let o=0;o<i;o++)s.add(e*o/i);let r=4*i;for(let{t:o,lasts:a,acc:c}of n.balls[t].pieces){if(o>e||r<=0)break;if(s.add(o),s.add(Math.min(e,o+a*(1-1e-9))),c[2]!==0&&a<e/20)for(let l=1;l<6;l++,r--)s.add(Math.min(e,o+a*l/6));r--}return[...s].sort((o,a)=>o-a)}var ns=n=>n==="inf"?1/0:n==="-inf"?-1/0:n??1/0,Bd=n=>n===1/0?"inf":n===-1/0?"-inf":n,va=Math.PI/180;function yn(n,t,e){return{...n,balls:n.balls.map((i,s)=>s===t?{...i,...e}:i)}}function kd(n,t,e){return{...n,walls:n.walls.map((i,s)=>t<0||s===t?e(i):i)}}function ks(n){let t=n.walls.find(s=>s.shape==="plane");if(!t)return null;let e=Ge(t.normal),i=Math.hypot(e[0],e[1]);return i>.3?[e[0]/i,e[1]/i,0]:null}function ba(n,t){let[e,i]=n.balls[t].velocity;if(e===0&&i===0)return 0;let s=ks(n);return s?Math.atan2(i*s[0]-e*s[1],-(e*s[0]+i*s[1]))/va:Math.atan2(i,e)/va}function Od(n,t,e,i){let s=ks(n),r=Math.cos(i*va)*e,o=Math.sin(i*va)*e,a=n.balls[t].velocity[2];return yn(n,t,{velocity:s?[-r*s[0]-o*s[1],-r*s[1]+o*s[0],a]:[r,o,a]})}function Bs(n){return n.rolling?[-n.velocity[1]/n.radius,n.velocity[0]/n.radius,n.spin_z??0]:n.spin??[0,0,0]}function Wr(n,t,e){let i=n.balls[t];if(!e)return yn(n,t,{rolling:e,spin:Bs(i),spin_z:null});let[s,r]=i.velocity,[o,a]=i.position;return yn(n,t,{rolling:e,spin:null,spin_z:Bs(i)[2],velocity:[s,r,0],position:[o,a,i.radius]})}function zd({velocity:[n,t]}){let e=Math.hypot(n,t),[i,s]=e>0?[n/e,t/e]:[1,0];return{top:[-s,i,0],way:[i,s,0]}}function Ma(n,t){let e=zd(n)[t],i=Bs(n);return i[0]*e[0]+i[1]*e[1]}function Fd(n,t,e,i){let s=n.balls[t],r=zd(s),o=e==="top"?i:Ma(s,"top"),a=e==="way"?i:Ma(s,"way"),c=[0,1].map(h=>o*r.top[h]+a*r.way[h]),l=s.rolling?Wr(n,t,!1):n;return yn(l,t,{spin:[c[0],c[1],Bs(s)[2]]})}var Vd=n=>n.restitution?.form==="constant"?n.restitution.value??1:null,Gd=(n,t)=>n.walls[Math.max(t,0)];function Ex(n,t,e){let i=Gd(n,e);if(!i)return null;let s=n.balls[t].radius;if(i.shape==="table")return i.nose_height===null||i.nose_height===void 0?s:i.nose_height;if(i.shape!=="plane"||!n.floor)return null;let r=Ge(i.normal);return Math.hypot(r[0],r[1])>.05?s*(1-r[2]):null}function Ax(n,t,e,i){let s=n.balls[t].radius;return kd(n,e,r=>{if(r.shape==="table")return{...r,nose_height:i<=s*(1+1e-6)?null:i};if(r.shape!=="plane")return r;let o=Ge(r.normal),a=Math.hypot(o[0],o[1]),c=Math.max(-.95,Math.min(.95,1-i/s)),l=Math.sqrt(1-c*c);return a>.05?{...r,normal:[o[0]/a*l,o[1]/a*l,c]}:r})}function Tx(n,t,e){let i=n.balls[t],[s,r,o]=i.position,a=n.floor&&Math.abs(o-i.radius)<1e-9*i.radius;return yn(n,t,{radius:e,position:[s,r,a?e:Math.max(o,n.floor?e:o)]})}var xa=n=>({read:(t,e,i)=>{let s=Gd(t,i);return s?n==="restitution"?s.restitution?Vd(s):1:ns(s[n]):null},write:(t,e,i,s)=>kd(t,i,r=>({...r,[n]:n==="restitution"?{form:"constant",value:s}:Bd(s)}))}),ya=n=>({read:({floor:t})=>t?n==="restitution"?Vd(t):ns(t[n]):null,write:(t,e,i,s)=>t.floor?{...t,floor:{...t.floor,[n]:n==="restitution"?{form:"constant",value:s}:Bd(s)}}:t}),Hd=[{key:"speed",group:"Ball",label:"Speed",unit:"m/s",scale:1,least:0,most:8,step:.01,help:"along the floor",read:(n,t)=>Math.hypot(n.balls[t].velocity[0],n.balls[t].velocity[1]),write:(n,t,e,i)=>Od(n,t,i,ba(n,t))},{key:"angle",group:"Ball",label:"Angle",unit:"\xB0",scale:1,least:-180,most:180,step:.1,help:"from the wall's normal; without a plane wall from the x axis",read:ba,write:(n,t,e,i)=>Od(n,t,Math.hypot(n.balls[t].velocity[0],n.balls[t].velocity[1]),i)},{key:"topspin",group:"Ball",label:"Top / back spin",unit:"rad/s",scale:1,least:-200,most:200,step:.1,help:"positive as in rolling forward, negative: backspin; moving it ends rolling",read:(n,t)=>Ma(n.balls[t],"top"),write:(n,t,e,i)=>Fd(n,t,"top",i)},{key:"sidespin",group:"Ball",label:"Side spin",unit:"rad/s",scale:1,least:-200,most:200,step:.1,help:"about the vertical, counterclockwise as seen from above",read:(n,t)=>Bs(n.balls[t])[2],write:(n,t,e,i)=>{let s=n.balls[t],[r,o]=Bs(s);return yn(n,t,s.rolling?{spin_z:i}:{spin:[r,o,i]})}},{key:"massespin",group:"Ball",label:"Spin about the way",unit:"rad/s",scale:1,least:-200,most:200,step:.1,help:"about the direction of motion, as after a mass\xE9; moving it ends rolling",read:(n,t)=>Ma(n.balls[t],"way"),write:(n,t,e,i)=>Fd(n,t,"way",i)},{key:"height",group:"Ball",label:"Height",unit:"mm",scale:1e3,least:0,most:1,step:.001,help:"of its lowest point above the floor",read:(n,t)=>n.floor?Math.max(0,n.balls[t].position[2]-n.balls[t].radius):null,write:(n,t,e,i)=>{let s=i>0&&n.balls[t].rolling?Wr(n,t,!1):n,{position:r,radius:o}=s.balls[t];return yn(s,t,{position:[r[0],r[1],o+Math.max(0,i)]})}},{key:"rise",group:"Ball",label:"Upward speed",unit:"m/s",scale:1,least:-5,most:5,step:.01,read:(n,t)=>n.balls[t].velocity[2],write:(n,t,e,i)=>{let s=i!==0&&n.balls[t].rolling?Wr(n,t,!1):n,[r,o]=s.balls[t].velocity;return yn(s,t,{velocity:[r,o,i]})}},{key:"radius",group:"Ball",label:"Radius",unit:"mm",scale:1e3,least:.005,most:.08,step:25e-5,read:(n,t)=>n.balls[t].radius,write:(n,t,e,i)=>Tx(n,t,i)},{key:"inertia",group:"Ball",label:"Inertia I/(m a\xB2)",unit:"",scale:1,least:.01,most:.66,step:.01,help:"0.4: solid ball; 0.667: thin shell",read:(n,t)=>mh(n.balls[t].inertia),write:(n,t,e,i)=>yn(n,t,{inertia:Math.abs(i-2/3)<.001?2/3:i})},{key:"restitution",group:"Wall",label:"Restitution",unit:"",scale:1,least:0,most:1,step:.01,...xa("restitution")},{key:"friction",group:"Wall",label:"Friction",unit:"",scale:1,least:0,most:1.5,step:.01,infinite:!0,help:"\u221E: never slips",...xa("friction")},{key:"tangential_restitution",group:"Wall",label:"Tangential restitution",unit:"",scale:1,least:-1,most:1,step:.01,help:"0 stops the slip, 1 reverses it; maw and stronge compute it from the stiffness ratio",...xa("tangential_restitution")},{key:"cushion_height",group:"Wall",label:"Cushion height",unit:"mm",scale:1e3,least:.01,most:.06,step:1e-4,help:"of the point where the wall touches the ball; at the ball's centre: an upright wall",read:Ex,write:Ax},{key:"stiffness_ratio",group:"Wall",label:"Stiffness ratio",unit:"",scale:1,least:.2,most:2,step:.01,help:"tangential over normal, of the laws maw and stronge",...xa("stiffness_ratio")},{key:"floor_restitution",group:"Floor",label:"Restitution",unit:"",scale:1,least:0,most:.95,step:.01,...ya("restitution")},{key:"floor_friction",group:"Floor",label:"Friction",unit:"",scale:1,least:0,most:1.5,step:.01,infinite:!0,help:"\u221E: never slips",...ya("friction")},{key:"rolling_resistance",group:"Floor",label:"Rolling resistance",unit:"",scale:1,least:0,most:.05,step:5e-4,...ya("rolling_resistance")},{key:"spin_friction",group:"Floor",label:"Spin friction",unit:"",scale:1,least:0,most:.05,step:5e-4,...ya("spin_friction")}];function Wd(n,t){let{key:e,label:i,unit:s,scale:r}=n,o={speed:[0,1e3],rise:[-1e3,1e3],height:[0,1e3],radius:[1e-4,1],inertia:[.001,2/3+1e-9],restitution:[0,1],floor_restitution:[0,1],friction:[0,1/0],floor_friction:[0,1/0],tangential_restitution:[-1,1],stiffness_ratio:[.001,1e3],rolling_resistance:[0,10],spin_friction:[0,10],angle:[-360,360],cushion_height:[1e-4,1]},[a,c]=o[e]??[-1e5,1e5];if(t>=a&&t<=c)return null;let l=h=>h===1/0?"\u221E":String(Number((h*r).toPrecision(4)));return`${i}: expected a number from ${l(a)} to ${l(c)}${s?` ${s}`:""}.`}var Xd={},_h={},xh=34,Xr=10,yh=13;function qd(n){return new Function("d","return {"+n.map(function(t,e){return JSON.stringify(t)+": d["+e+'] || ""'}).join(",")+"}")}function Cx(n,t){var e=qd(n);return function(i,s){return t(e(i),s,n)}}function $d(n){var t=Object.create(null),e=[];return n.forEach(function(i){for(var s in i)s in t||e.push(t[s]=s)}),e}function rn(n,t){var e=n+"",i=e.length;return i<t?new Array(t-i+1).join(0)+e:e}function Rx(n){return n<0?"-"+rn(-n,6):n>9999?"+"+rn(n,6):rn(n,4)}function Px(n){var t=n.getUTCHours(),e=n.getUTCMinutes(),i=n.getUTCSeconds(),s=n.getUTCMilliseconds();return isNaN(n)?"Invalid Date":Rx(n.getUTCFullYear(),4)+"-"+rn(n.getUTCMonth()+1,2)+"-"+rn(n.getUTCDate(),2)+(s?"T"+rn(t,2)+":"+rn(e,2)+":"+rn(i,2)+"."+rn(s,3)+"Z":i?"T"+rn(t,2)+":"+rn(e,2)+":"+rn(i,2)+"Z":e||t?"T"+rn(t,2)+":"+rn(e,2)+"Z":"")}function is(n){var t=new RegExp('["'+n+`
\r]`),e=n.charCodeAt(0);function i(u,f){var d,g,_=s(u,function(m,p){if(d)return d(m,p-1);g=m,d=f?Cx(m,f):qd(m)});return _.columns=g||[],_}function s(u,f){var d=[],g=u.length,_=0,m=0,p,y=g<=0,b=!1;u.charCodeAt(g-1)===Xr&&--g,u.charCodeAt(g-1)===yh&&--g;function v(){if(y)return _h;if(b)return b=!1,Xd;var E,x=_,w;if(u.charCodeAt(x)===xh){for(;_++<g&&u.charCodeAt(_)!==xh||u.charCodeAt(++_)===xh;);return(E=_)>=g?y=!0:(w=u.charCodeAt(_++))===Xr?b=!0:w===yh&&(b=!0,u.charCodeAt(_)===Xr&&++_),u.slice(x+1,E-1).replace(/""/g,'"')}for(;_<g;){if((w=u.charCodeAt(E=_++))===Xr)b=!0;else if(w===yh)b=!0,u.charCodeAt(_)===Xr&&++_;else if(w!==e)continue;return u.slice(x,E)}return y=!0,u.slice(x,g)}for(;(p=v())!==_h;){for(var A=[];p!==Xd&&p!==_h;)A.push(p),p=v();f&&(A=f(A,m++))==null||d.push(A)}return d}function r(u,f){return u.map(function(d){return f.map(function(g){return h(d[g])}).join(n)})}function o(u,f){return f==null&&(f=$d(u)),[f.map(h).join(n)].concat(r(u,f)).join(`
`)}function a(u,f){return f==null&&(f=$d(u)),r(u,f).join(`
`)}function c(u){return u.map(l).join(`
`)}function l(u){return u.map(h).join(n)}function h(u){return u==null?"":u instanceof Date?Px(u):t.test(u+="")?'"'+u.replace(/"/g,'""')+'"':u}return{parse:i,parseRows:s,format:o,formatBody:a,formatRows:c,formatRow:l,formatValue:h}}var ss=is(","),Ix=ss.parse,vh=ss.parseRows,Lx=ss.format,Nx=ss.formatBody,bh=ss.formatRows,Dx=ss.formatRow,Ux=ss.formatValue;var rs=is("	"),Ox=rs.parse,Mh=rs.parseRows,Fx=rs.format,Bx=rs.formatBody,kx=rs.formatRows,zx=rs.formatRow,Vx=rs.formatValue;var $x=/^[a-z0-9-_]+$/i,Yd=!!"".isWellFormed;function qr(n){let t=typeof n;if(t==="object"){if(Array.isArray(n))return"array";if(typeof n.getUTCDate=="function"&&n instanceof Date)return"date";if(globalThis.Temporal){if(n.until){if(n instanceof Temporal.ZonedDateTime)return"temporal/tz+uc";if(n instanceof Temporal.PlainDateTime||n instanceof Temporal.PlainDate)return"temporal/uc";if(n instanceof Temporal.PlainTime||n instanceof Temporal.Instant)return"temporal";if(n instanceof Temporal.PlainYearMonth)return"temporal/x"}else if(n.toPlainDate&&n instanceof Temporal.PlainMonthDay||n.negated&&n instanceof Temporal.Duration)return"temporal/x"}}return t}function qx(n){for(let t=0;t<n.length;t++)if(qr(n[t])!=="object")return!1;return n.length!=0}function Zd(n){return JSON.stringify(n).replaceAll("\x7F","\\u007f")}function Yx(n){return Zd(Yd?n.toWellFormed():n)}function Jd(n){if($x.test(n))return n;if(Yd&&!n.isWellFormed())throw new RangeError("key contains illegal lone surrogates");return Zd(n)}function Sh(n,t,e,i,s){if(e===0)throw new Error("Could not stringify the object: maximum object depth exceeded");switch(t){case"number":if(isNaN(n))return"nan";if(n===1/0)return"inf";if(n===-1/0)return"-inf";if(Number.isInteger(n)&&(i||!Number.isSafeInteger(n)))return n.toFixed(1);case"bigint":case"boolean":case"temporal":return n.toString();case"string":return Yx(n);case"date":if(isNaN(n.getTime()))throw new TypeError("cannot serialize invalid date");return n.toISOString();case"object":return Zx(n,e,i,s);case"array":return Jx(n,e,i,s);case"temporal/tz+uc":if(s){let r=n.timeZoneId,o=r.charCodeAt(0);if(o!==43&&o!==45&&(o!==85&&o!==71&&o!==90&&o!==69||r!=="UTC"&&r!=="UCT"&&r!=="Universal"&&r!=="Zulu"&&!r.startsWith("GMT")&&r!=="Greenwich"&&!r.startsWith("Etc/")))throw new TypeError("Temporal objects with an IANA timezone are not allowed in Temporal strict mode")}case"temporal/uc":if(s&&n.calendarId!=="iso8601")throw new TypeError("Temporal objects with a non-default calendar are not allowed in Temporal strict mode");return n.toString({calendarName:"never",timeZoneName:"never"});case"temporal/x":throw new TypeError("Unsupported "+n[Symbol.toStringTag])}}function Zx(n,t,e,i){let s=Object.keys(n);if(s.length===0)return"{}";let r="{ ";for(let o=0;o<s.length;o++){let a=s[o];o&&(r+=", "),r+=Jd(a)+" = "+Sh(n[a],qr(n[a]),t-1,e,i)}return r+" }"}function Jx(n,t,e,i){if(n.length===0)return"[]";let s="[ ";for(let r=0;r<n.length;r++){if(r&&(s+=", "),n[r]===null||n[r]===void 0)throw new TypeError("arrays cannot contain null or undefined values");s+=Sh(n[r],qr(n[r]),t-1,e,i)}return s+" ]"}function Kx(n,t,e,i,s){if(e===0)throw new Error("Could not stringify the object: maximum object depth exceeded");let r="";for(let o=0;o<n.length;o++)r+=`${r&&`
`}[[${t}]]
`,r+=wh(0,n[o],t,e,i,s);return r}function wh(n,t,e,i,s,r){if(i===0)throw new Error("Could not stringify the object: maximum object depth exceeded");let o="",a="",c=Object.keys(t);for(let l=0;l<c.length;l++){let h=c[l];if(t[h]!==null&&t[h]!==void 0){let u=qr(t[h]);if(u==="symbol"||u==="function")throw new TypeError(`cannot serialize values of type '${u}'`);let f=Jd(h);if(u==="array"&&qx(t[h]))a+=(a&&`
`)+Kx(t[h],e?`${e}.${f}`:f,i-1,s,r);else if(u==="object"){let d=e?`${e}.${f}`:f;a+=(a&&`
`)+wh(d,t[h],d,i-1,s,r)}else o+=f,o+=" = ",o+=Sh(t[h],u,i,s,r),o+=`
`}}return n&&(o||!a)&&(o=o?`[${n}]
${o}`:`[${n}]`),o&&a?`${o}
${a}`:o||a}function Eh(n,{maxDepth:t=1e3,numbersAsFloat:e=!1,strictTemporal:i=!1}={}){if(qr(n)!=="object")throw new TypeError("stringify can only be called with an object");let s=wh(0,n,"",t,e,i);return s[s.length-1]!==`
`?s+`
`:s}function Th(n){if(n==="inf")return 1/0;if(n==="-inf")return-1/0;if(Array.isArray(n))return n.map(Th);if(n&&typeof n=="object"){let t=n;return t.form==="constant"&&"value"in t?t.value:Object.fromEntries(Object.entries(n).filter(([,e])=>e!=null).map(([e,i])=>[e,Th(i)]))}return n}function Qd(n){let t=n.balls.map(({spin:i,spin_z:s,rolling:r,...o})=>({...o,rolling:r,...r?{spin_z:s}:{spin:i}})),e=Th({...n,balls:t});return`# A scene of carom: carom simulate FILE, carom explore FILE. SI units.
${Eh(e,{numbersAsFloat:!1})}`}var Kd=["x","y","z"];function tp(n,t){let e=(r,o="")=>Kd.map(a=>`${r}${a}${o}`),i=["t","kind","ball","name","other","phase",...Kd,...e("v","_before"),...e("w","_before"),...e("v"),...e("w"),"required_friction"],s=t.events.map(r=>[r.t,r.kind,r.ball,Yr(n,r.ball),r.other??-1,r.phase,...r.x,...r.v_before??[],...r.w_before??[],...r.v,...r.w,r.required??""]);return bh([i,...s].map(r=>r.map(String)))}var Yr=(n,t)=>n.balls[t]?.name??`ball ${t}`,Ch=(n,t)=>n.walls[t]?.name??`${n.walls[t]?.shape??"wall"} ${t}`,jx={wall:"meets",ball:"meets",floor:"lands",rolling:"rolls",sliding:"slides",pivoting:"spins on the spot",rest:"comes to rest",settled:"bounces no more",left:"clears",held:"is held",flight:"flies",bouncing:"bounces",start:"starts"};function ep(n,t){let e=t.kind==="ball"?Yr(n,t.other??0):t.kind==="wall"||t.kind==="left"?Ch(n,t.other??0):"";return`${Yr(n,t.ball)} ${jx[t.kind]??t.kind} ${e}`.trim()}var Qx=5e6,jd=2e4,Ah={m_s:1,cm_s:.01,mm_s:.001,km_h:1/3.6,ft_s:.3048,in_s:.0254,mph:.44704},Sa=["v_n_in","v_t_in","v_n_out","v_t_out"];function ty(n){let t=n.trim().toLowerCase(),e=/^(.*?)\s*[[(]([^\])]*)[\])]$/.exec(t),i=(e?e[1]:t).trim().replaceAll(" ","_").replace(/^v([nt])_/,"v_$1_").replace(/_derived$/,"");for(let s of Sa){if(e&&i===s){let r=Ah[e[2].trim().replace("/","_")];if(r===void 0)throw new Error(`Column ${JSON.stringify(n)}: expected a unit of speed, such as m/s or mm/s.`);return{name:s,factor:r}}if(i===s)return{name:s,factor:1};if(i.startsWith(`${s}_`)&&Ah[i.slice(s.length+1)]!==void 0)return{name:s,factor:Ah[i.slice(s.length+1)]}}return null}function np(n){if(n.length>Qx)throw new Error("This file is too large for the page: expected at most 5 MB.");if(n.includes("\0"))throw new Error("This file holds no text: expected a CSV table of rebounds.");let t=n.slice(0,n.search(/\r?\n|$/)),e=!t.includes(",")&&t.includes(";"),s=(e?l=>is(";").parseRows(l):t.includes("	")&&!t.includes(",")?Mh:vh)(n.replace(/^\uFEFF/,"")).filter(l=>l.some(h=>h.trim()));if(s.length<2)throw new Error("Expected a table of rebounds with a header and at least one row.");if(s.length>jd)throw new Error(`Expected at most ${jd} rows, got ${s.length-1}; carom fit takes more.`);let r=new Map,o=-1;s[0].forEach((l,h)=>{l.trim().toLowerCase()==="stage"&&(o=h);let u=ty(l);u&&r.set(u.name,{at:h,factor:u.factor})});let a=Sa.filter(l=>!r.has(l));if(a.length)throw new Error(`Expected a table of rebounds, with the columns ${Sa.join(", ")}; this one lacks ${a.join(", ")}.`);let c=[];if(s.slice(1).forEach((l,h)=>{let[u,f,d,g]=Sa.map(y=>{let{at:b,factor:v}=r.get(y),A=(l[b]??"").trim();if(!A)return NaN;let E=Number(e?A.replace(",","."):A);if(!Number.isFinite(E))throw new Error(`Row ${h+1}, ${y}: expected a number, got ${JSON.stringify(A.slice(0,30))}.`);return E*v}),_=f<0?-1:1,m=Math.atan2(_*f,u)*180/Math.PI,p=Math.atan2(_*g,d)*180/Math.PI;Number.isFinite(m)&&Number.isFinite(p)&&c.push({incidence:m,reflection:p,stage:o<0?"":(l[o]??"").trim().slice(0,20)})}),!c.length)throw new Error("Expected rows with all four speeds, got none.");return c}function ip(n,t,e,i){let s=!1,r=[],o=Jt("select",{id:"ball-choice","aria-label":"Ball",change:()=>t.change({ball:Number(o.value)},"scene","laws")}),a=Jt("select",{id:"wall-choice","aria-label":"Wall",change:()=>t.change({wall:Number(a.value)},"scene")}),c=Jt("input",{type:"checkbox",id:"rolling",change:()=>{t.remember(),e(Wr(t.state.scene,t.state.ball,c.checked))}}),l=(d,g)=>g===1/0?d.most+d.step*4:Math.max(d.least,Math.min(d.most,g));for(let d of["Ball","Wall","Floor"]){let g=Jt("section",{class:"controls","aria-label":d}),_=Jt("div",{class:"head"},Jt("h2",{},d));d==="Ball"&&_.append(o,Jt("label",{class:"check"},c,"rolling")),d==="Wall"&&_.append(a),g.append(_);for(let m of Hd.filter(p=>p.group===d)){let p=`control-${m.key}`,y=Jt("input",{type:"range",id:p,min:String(m.least),max:String(m.infinite?m.most+m.step*4:m.most),step:"any",change:()=>s=!1,input:()=>{s||t.remember(),s=!0;let A=Number(y.value),E=m.infinite&&A>m.most+m.step?1/0:Math.round(A/m.step)*m.step;h(m,E)}}),b=Jt("input",{type:"text",inputmode:"decimal",autocomplete:"off","aria-label":`${m.label}${m.unit?`, ${m.unit}`:""}`,id:`${p}-number`,change:()=>{let A=b.value.trim().replace("\u2212","-").replace(",","."),E=/^(inf|∞)$/i.test(A)?1/0:A===""?NaN:Number(A)/m.scale,x=Wd(m,E);if(x){i(x),f();return}t.remember(),h(m,E)}}),v=Jt("div",{class:"row",...m.help?{title:m.help}:{}},Jt("label",{for:p},m.label),y,b,Jt("span",{class:"unit"},m.unit));g.append(v),r.push({control:m,row:v,range:y,field:b})}n.append(g)}function h(d,g){let{scene:_,ball:m,wall:p}=t.state;e(d.write(_,m,p,g===1/0?g:Number(g.toPrecision(12))))}function u(d,g,_,m){let p=g.join(`
`);d.dataset.names!==p&&(d.replaceChildren(...g.map((y,b)=>Jt("option",{value:String(b+_)},y))),d.dataset.names=p),d.value=String(m),d.hidden=g.length<2}function f(){let{scene:d,ball:g,wall:_}=t.state;u(o,d.balls.map((m,p)=>Yr(d,p)),0,g),u(a,d.walls.length>1?["all walls",...d.walls.map((m,p)=>Ch(d,p))]:["wall"],-1,_),c.checked=d.balls[g].rolling,c.disabled=!d.floor;for(let{control:m,row:p,range:y,field:b}of r){let v=m.read(d,g,_);if(p.hidden=v===null,v===null)continue;if(m.key==="angle"){let E=ks(d)?89.9:180;y.min=String(-E),y.max=String(E)}let A=v===1/0?"\u221E":String(Number((v*m.scale).toPrecision(4)));document.activeElement!==y&&(y.value=String(l(m,v))),y.setAttribute("aria-valuetext",`${A} ${m.unit}`.trim()),(document.activeElement!==b||b.dataset.said===b.value)&&(b.value=b.dataset.said=A)}for(let m of n.querySelectorAll("section"))m.hidden=[...m.querySelectorAll(".row")].every(p=>p.hidden)}return{update:f}}function ey(n,t){let e=document.createElementNS("http://www.w3.org/2000/svg","svg");e.setAttribute("viewBox","0 0 26 8"),e.setAttribute("class","sample"),e.setAttribute("aria-hidden","true");let i=document.createElementNS("http://www.w3.org/2000/svg","path");return i.setAttribute("d","M1 4H25"),i.setAttribute("stroke",n),i.setAttribute("stroke-width","3"),t&&i.setAttribute("stroke-dasharray",t.map(s=>s*2).join(" ")),e.append(i),e}function sp(n,t){let e=Jt("p",{class:"nothing",hidden:!0});n.append(e);let i=t.state.cards.map(s=>{let r=Jt("input",{type:"checkbox",id:`law-${s.name}`,"aria-label":`show ${s.name}`,change:()=>{let{laws:f,followed:d}=t.state,g=t.state.cards.map(({name:_})=>_).filter(_=>_===s.name?r.checked:f.includes(_));t.change({laws:g,followed:g.includes(d)?d:g[0]??""},"laws")}}),o=Jt("button",{type:"button",class:"follow",title:`${s.summary} Press to follow its balls.`,click:()=>{let f=t.state.laws.includes(s.name)?t.state.laws:t.state.cards.map(({name:d})=>d).filter(d=>d===s.name||t.state.laws.includes(d));t.change({followed:s.name,laws:f},"laws")}},s.name),a=Jt("span",{class:"swatch"}),c=Jt("ul",{class:"why",hidden:!0,id:`why-${s.name}`}),l=Jt("button",{type:"button",class:"verdict","aria-controls":c.id,"aria-expanded":"false",click:()=>{c.hidden=!c.hidden,l.setAttribute("aria-expanded",String(!c.hidden))}}),h=Jt("dl",{}),u=Jt("article",{class:"law","data-law":s.name},Jt("header",{},r,a,o,l),c,h);return n.append(u),{card:s,box:r,follow:o,swatch:a,verdict:l,numbers:h,why:c,root:u}});return{update(s,r,o,a){e.textContent=a,e.hidden=!a;for(let{card:c,box:l,follow:h,swatch:u,verdict:f,numbers:d,why:g,root:_}of i){let m=s.get(c.name),p=o.get(c.name),y=r.get(c.name)??"currentColor",b=t.state.laws.includes(c.name);l.checked=b,_.style.setProperty("--law",y),_.classList.toggle("off",!b),_.classList.toggle("followed",t.state.followed===c.name),h.setAttribute("aria-pressed",String(t.state.followed===c.name)),u.replaceChildren(ey(y,c.dashes));let v=p?[p]:m?.reasons??[],A=m?.admissible&&!p;f.textContent=m||p?A?"\u2713 may apply":"\u2717 may not apply":"",f.className=`verdict ${A?"yes":"no"}`,f.disabled=v.length===0,f.title=v.join("; "),g.replaceChildren(...v.map(E=>Jt("li",{},E))),d.replaceChildren(...m?ny(m):[])}}}}function ny({angle:n,velocity:t,spin:e,energy_kept:i,hop:s,required:r,available:o}){return[["angle","angle",n===null?"\u2013":`${n.toFixed(1)}\xB0`],["energy","energy kept",i===null?"\u2013":`${(100*i).toFixed(1)} %`],["hop","hop",s===null?"\u2013":Ld(s)],["friction","\u03BC needed",r===null?"\u2013":`${oi(r,2)} of ${oi(o,2)}`],["velocity","velocity",t?`${t.map(c=>oi(c)).join(", ")} m/s`:"\u2013"],["spin","spin",e?`${e.map(c=>oi(c)).join(", ")} rad/s`:"\u2013"]].map(([c,l,h])=>Jt("div",{class:c},Jt("dt",{},l),Jt("dd",{},h)))}var iy=2e3,sy=600,wa="as in the scene",li=n=>n instanceof Error?n.message:String(n);function zs(n,t){let e=n.faults(t);if(e.length)throw new Error(e.slice(0,3).join(". ")+(e.length>3?`. (${e.length-3} more)`:""));return t}function Vs(n,t,e){let i={runs:new Map,notes:new Map,fault:null};for(let s of e)try{let r=n.run(t,s===wa?void 0:s,{events:iy,milliseconds:sy/e.length});i.runs.set(s,r);let o=`after ${r.events.length} events, at ${Number(r.until.toPrecision(4))} s`;r.status==="refused"&&i.notes.set(s,r.why),(r.status==="limit"||r.status==="time")&&i.notes.set(s,`The run is cut off ${o}: carom simulate goes on.`)}catch(r){i.notes.set(s,li(r))}return e.length&&!i.runs.size&&(i.fault=[...i.notes.values()][0]),i}function Rh(n,t){try{return{verdicts:new Map(n.compare(t).map(e=>[e.law,e])),none:""}}catch(e){return{verdicts:new Map,none:li(e)}}}var rp=Array.from({length:30},(n,t)=>1+3*t);function op(n,t,e){let i=new Map;for(let s of e)if(s!==wa)try{i.set(s,n.curve(s,t,rp).map((r,o)=>[rp[o],r??NaN]))}catch{}return i}function Ph(n,t){let e=0;for(let s of t){let r=s.events.at(-1)?.t??0,o=s.final.every(({phase:c})=>c==="rest"),a=s.status==="done"||s.status==="quiet";e=Math.max(e,o||!a?r:r*1.3+.3)}let i=n.run.duration;return Math.max(1e-6,i===null?e||1:Math.min(e||i,i))}function Ih(n,t){let e=[];for(let i of t?.events??[])i.kind==="start"||i.kind==="ball"&&(i.other??0)<i.ball||e.push({t:i.t,text:ep(n,i)});return e}function Lh(n,t){let e=n.filter(({name:s})=>s!==wa);return t.walls.some(s=>s.law!==null&&s.law!==void 0)?[{name:wa,summary:"Each wall with its own law.",valid:"",colour:"#777777",dashes:null,reads:null},...e]:e}function ap(n,t){return ks(n)?Math.abs(ba(n,t)):null}var ry=6e4;function lp({scene:n,laws:t,followed:e,t:i}){let s=new TextEncoder().encode(JSON.stringify({scene:n,laws:t,followed:e,t:Number(i.toPrecision(9))})),r="";for(let o of s)r+=String.fromCharCode(o);return`#s=${btoa(r).replaceAll("+","-").replaceAll("/","_").replace(/=+$/,"")}`}function Nh(n,t,e){let i=new URLSearchParams(n.replace(/^#/,"")).get("s");if(i===null)return null;if(i.length>ry)throw new Error("This link is too long to be one of the explorer's.");let s;try{let l=atob(i.replaceAll("-","+").replaceAll("_","/"));s=JSON.parse(new TextDecoder("utf-8",{fatal:!0}).decode(Uint8Array.from(l,h=>h.charCodeAt(0))))}catch{throw new Error("This link is damaged: it may have been cut off when it was copied.")}if(typeof s!="object"||s===null)throw new Error("This link holds no scene.");let r=zs(t,s.scene),o=Array.isArray(s.laws)?e.filter(l=>s.laws.includes(l)):e,a=e.includes(s.followed)?s.followed:"",c=typeof s.t=="number"&&s.t>=0&&s.t<1e6?s.t:0;return{scene:r,laws:o,followed:a,t:c}}function Dh(n,t){let e=URL.createObjectURL(t),i=Jt("a",{href:e,download:n});document.body.append(i),i.click(),i.remove(),setTimeout(()=>URL.revokeObjectURL(e),1e4)}function cp(n,t,e,i){let s=()=>{let{scene:l,laws:h,followed:u,t:f}=n.state;return lp({scene:l,laws:h,followed:u,t:f})},r=0;n.listen(l=>{n.state.playing||l.size===1&&l.has("data")||(clearTimeout(r),r=window.setTimeout(()=>{try{history.replaceState(null,"",s())}catch{}},250))}),Zt("link").onclick=async()=>{let l=location.href.split("#")[0]+s();if(location.protocol==="about:"){i("A notebook's frame has no address: save the scene instead, or write the page with carom explore --out.");return}try{history.replaceState(null,"",s()),await navigator.clipboard.writeText(l),i("The link is copied.",!0)}catch{i("The link is in the address bar.",!0)}};let o=()=>document.querySelector("details.menu").removeAttribute("open");Zt("save-scene").onclick=()=>{let{scene:l,followed:h}=n.state,u=l.walls.some(f=>f.law)||!h;Dh("scene.toml",new Blob([Qd(u?l:{...l,run:{...l.run,law:h}})],{type:"application/toml"})),o()},Zt("save-events").onclick=()=>{let l=e();l?Dh("events.csv",new Blob([tp(n.state.scene,l)],{type:"text/csv"})):i("No law is shown: switch one on to save its events."),o()},Zt("save-picture").onclick=async()=>{o();try{Dh("scene.png",await t.picture())}catch(l){i(li(l))}};async function a(l){if(/\.toml$/i.test(l.name)){i("A scene is opened by carom explore FILE; here a table of measured rebounds (CSV) can be dropped.");return}try{if(l.size>2e7)throw new Error("This file is too large for the page: expected at most 5 MB.");let h=np(await l.text());n.change({rebounds:h,reboundsFrom:l.name},"data"),i(`${h.length} measured rebounds from ${l.name}.`,!0)}catch(h){i(`${l.name}: ${li(h)}`)}}addEventListener("dragover",l=>{l.preventDefault(),document.body.classList.add("dropping")}),addEventListener("dragleave",l=>{l.relatedTarget||document.body.classList.remove("dropping")}),addEventListener("drop",l=>{l.preventDefault(),document.body.classList.remove("dropping");let h=l.dataTransfer?.files[0];h&&a(h)});let c=Zt("file");c.onchange=()=>{c.files?.[0]&&a(c.files[0]),c.value=""}}function Ea(n,t){return n==null||t==null?NaN:n<t?-1:n>t?1:n>=t?0:NaN}function oy(n,t){return n==null||t==null?NaN:t<n?-1:t>n?1:t>=n?0:NaN}function hp(n){let t,e,i;n.length!==2?(t=Ea,e=(a,c)=>Ea(n(a),c),i=(a,c)=>n(a)-c):(t=n===Ea||n===oy?n:ay,e=n,i=n);function s(a,c,l=0,h=a.length){if(l<h){if(t(c,c)!==0)return h;do{let u=l+h>>>1;e(a[u],c)<0?l=u+1:h=u}while(l<h)}return l}function r(a,c,l=0,h=a.length){if(l<h){if(t(c,c)!==0)return h;do{let u=l+h>>>1;e(a[u],c)<=0?l=u+1:h=u}while(l<h)}return l}function o(a,c,l=0,h=a.length){let u=s(a,c,l,h-1);return u>l&&i(a[u-1],c)>-i(a[u],c)?u-1:u}return{left:s,center:o,right:r}}function ay(){return 0}function ly(n){return n===null?NaN:+n}var up=hp(Ea),fp=up.right,XT=up.left,$T=hp(ly).center;var qT=dp(pp),YT=dp(cy);function dp(n){return function(t,e,i=e){if(!((e=+e)>=0))throw new RangeError("invalid rx");if(!((i=+i)>=0))throw new RangeError("invalid ry");let{data:s,width:r,height:o}=t;if(!((r=Math.floor(r))>=0))throw new RangeError("invalid width");if(!((o=Math.floor(o!==void 0?o:s.length/r))>=0))throw new RangeError("invalid height");if(!r||!o||!e&&!i)return t;let a=e&&n(e),c=i&&n(i),l=s.slice();return a&&c?(Gs(a,l,s,r,o),Gs(a,s,l,r,o),Gs(a,l,s,r,o),Hs(c,s,l,r,o),Hs(c,l,s,r,o),Hs(c,s,l,r,o)):a?(Gs(a,s,l,r,o),Gs(a,l,s,r,o),Gs(a,s,l,r,o)):c&&(Hs(c,s,l,r,o),Hs(c,l,s,r,o),Hs(c,s,l,r,o)),t}}function Gs(n,t,e,i,s){for(let r=0,o=i*s;r<o;)n(t,e,r,r+=i,1)}function Hs(n,t,e,i,s){for(let r=0,o=i*s;r<i;++r)n(t,e,r,r+o,i)}function cy(n){let t=pp(n);return(e,i,s,r,o)=>{s<<=2,r<<=2,o<<=2,t(e,i,s+0,r+0,o),t(e,i,s+1,r+1,o),t(e,i,s+2,r+2,o),t(e,i,s+3,r+3,o)}}function pp(n){let t=Math.floor(n);if(t===n)return hy(n);let e=n-t,i=2*n+1;return(s,r,o,a,c)=>{if(!((a-=c)>=o))return;let l=t*r[o],h=c*t,u=h+c;for(let f=o,d=o+h;f<d;f+=c)l+=r[Math.min(a,f)];for(let f=o,d=a;f<=d;f+=c)l+=r[Math.min(a,f+h)],s[f]=(l+e*(r[Math.max(o,f-u)]+r[Math.min(a,f+u)]))/i,l-=r[Math.max(o,f-h)]}}function hy(n){let t=2*n+1;return(e,i,s,r,o)=>{if(!((r-=o)>=s))return;let a=n*i[s],c=o*n;for(let l=s,h=s+c;l<h;l+=o)a+=i[Math.min(r,l)];for(let l=s,h=r;l<=h;l+=o)a+=i[Math.min(r,l+c)],e[l]=a/t,a-=i[Math.max(s,l-c)]}}var uy=Array.prototype,ZT=uy.slice;var fy=Math.sqrt(50),dy=Math.sqrt(10),py=Math.sqrt(2);function Aa(n,t,e){let i=(t-n)/Math.max(0,e),s=Math.floor(Math.log10(i)),r=i/Math.pow(10,s),o=r>=fy?10:r>=dy?5:r>=py?2:1,a,c,l;return s<0?(l=Math.pow(10,-s)/o,a=Math.round(n*l),c=Math.round(t*l),a/l<n&&++a,c/l>t&&--c,l=-l):(l=Math.pow(10,s)*o,a=Math.round(n/l),c=Math.round(t/l),a*l<n&&++a,c*l>t&&--c),c<a&&.5<=e&&e<2?Aa(n,t,e*2):[a,c,l]}function mp(n,t,e){if(t=+t,n=+n,e=+e,!(e>0))return[];if(n===t)return[n];let i=t<n,[s,r,o]=i?Aa(t,n,e):Aa(n,t,e);if(!(r>=s))return[];let a=r-s+1,c=new Array(a);if(i)if(o<0)for(let l=0;l<a;++l)c[l]=(r-l)/-o;else for(let l=0;l<a;++l)c[l]=(r-l)*o;else if(o<0)for(let l=0;l<a;++l)c[l]=(s+l)/-o;else for(let l=0;l<a;++l)c[l]=(s+l)*o;return c}function Ta(n,t,e){return t=+t,n=+n,e=+e,Aa(n,t,e)[2]}function gp(n,t,e){t=+t,n=+n,e=+e;let i=t<n,s=i?Ta(t,n,e):Ta(n,t,e);return(i?-1:1)*(s<0?1/-s:s)}var JT=my(Math.random);function my(n){return function(e,i=0,s=e.length){let r=s-(i=+i);for(;r;){let o=n()*r--|0,a=e[r+i];e[r+i]=e[o+i],e[o+i]=a}return e}}function _p(n,t){switch(arguments.length){case 0:break;case 1:this.range(n);break;default:this.range(t).domain(n);break}return this}function qs(n,t,e){n.prototype=t.prototype=e,e.constructor=n}function Kr(n,t){var e=Object.create(n.prototype);for(var i in t)e[i]=t[i];return e}function Ii(){}var cs=.7,$s=1/cs,Ws="\\s*([+-]?\\d+)\\s*",Zr="\\s*([+-]?(?:\\d*\\.)?\\d+(?:[eE][+-]?\\d+)?)\\s*",Wn="\\s*([+-]?(?:\\d*\\.)?\\d+(?:[eE][+-]?\\d+)?)%\\s*",gy=/^#([0-9a-f]{3,8})$/,_y=new RegExp(`^rgb\\(${Ws},${Ws},${Ws}\\)$`),xy=new RegExp(`^rgb\\(${Wn},${Wn},${Wn}\\)$`),yy=new RegExp(`^rgba\\(${Ws},${Ws},${Ws},${Zr}\\)$`),vy=new RegExp(`^rgba\\(${Wn},${Wn},${Wn},${Zr}\\)$`),by=new RegExp(`^hsl\\(${Zr},${Wn},${Wn}\\)$`),My=new RegExp(`^hsla\\(${Zr},${Wn},${Wn},${Zr}\\)$`),xp={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074};qs(Ii,Ys,{copy(n){return Object.assign(new this.constructor,this,n)},displayable(){return this.rgb().displayable()},hex:yp,formatHex:yp,formatHex8:Sy,formatHsl:wy,formatRgb:vp,toString:vp});function yp(){return this.rgb().formatHex()}function Sy(){return this.rgb().formatHex8()}function wy(){return Rp(this).formatHsl()}function vp(){return this.rgb().formatRgb()}function Ys(n){var t,e;return n=(n+"").trim().toLowerCase(),(t=gy.exec(n))?(e=t[1].length,t=parseInt(t[1],16),e===6?bp(t):e===3?new Re(t>>8&15|t>>4&240,t>>4&15|t&240,(t&15)<<4|t&15,1):e===8?Ca(t>>24&255,t>>16&255,t>>8&255,(t&255)/255):e===4?Ca(t>>12&15|t>>8&240,t>>8&15|t>>4&240,t>>4&15|t&240,((t&15)<<4|t&15)/255):null):(t=_y.exec(n))?new Re(t[1],t[2],t[3],1):(t=xy.exec(n))?new Re(t[1]*255/100,t[2]*255/100,t[3]*255/100,1):(t=yy.exec(n))?Ca(t[1],t[2],t[3],t[4]):(t=vy.exec(n))?Ca(t[1]*255/100,t[2]*255/100,t[3]*255/100,t[4]):(t=by.exec(n))?wp(t[1],t[2]/100,t[3]/100,1):(t=My.exec(n))?wp(t[1],t[2]/100,t[3]/100,t[4]):xp.hasOwnProperty(n)?bp(xp[n]):n==="transparent"?new Re(NaN,NaN,NaN,0):null}function bp(n){return new Re(n>>16&255,n>>8&255,n&255,1)}function Ca(n,t,e,i){return i<=0&&(n=t=e=NaN),new Re(n,t,e,i)}function zh(n){return n instanceof Ii||(n=Ys(n)),n?(n=n.rgb(),new Re(n.r,n.g,n.b,n.opacity)):new Re}function jr(n,t,e,i){return arguments.length===1?zh(n):new Re(n,t,e,i??1)}function Re(n,t,e,i){this.r=+n,this.g=+t,this.b=+e,this.opacity=+i}qs(Re,jr,Kr(Ii,{brighter(n){return n=n==null?$s:Math.pow($s,n),new Re(this.r*n,this.g*n,this.b*n,this.opacity)},darker(n){return n=n==null?cs:Math.pow(cs,n),new Re(this.r*n,this.g*n,this.b*n,this.opacity)},rgb(){return this},clamp(){return new Re(as(this.r),as(this.g),as(this.b),Pa(this.opacity))},displayable(){return-.5<=this.r&&this.r<255.5&&-.5<=this.g&&this.g<255.5&&-.5<=this.b&&this.b<255.5&&0<=this.opacity&&this.opacity<=1},hex:Mp,formatHex:Mp,formatHex8:Ey,formatRgb:Sp,toString:Sp}));function Mp(){return`#${os(this.r)}${os(this.g)}${os(this.b)}`}function Ey(){return`#${os(this.r)}${os(this.g)}${os(this.b)}${os((isNaN(this.opacity)?1:this.opacity)*255)}`}function Sp(){let n=Pa(this.opacity);return`${n===1?"rgb(":"rgba("}${as(this.r)}, ${as(this.g)}, ${as(this.b)}${n===1?")":`, ${n})`}`}function Pa(n){return isNaN(n)?1:Math.max(0,Math.min(1,n))}function as(n){return Math.max(0,Math.min(255,Math.round(n)||0))}function os(n){return n=as(n),(n<16?"0":"")+n.toString(16)}function wp(n,t,e,i){return i<=0?n=t=e=NaN:e<=0||e>=1?n=t=NaN:t<=0&&(n=NaN),new Tn(n,t,e,i)}function Rp(n){if(n instanceof Tn)return new Tn(n.h,n.s,n.l,n.opacity);if(n instanceof Ii||(n=Ys(n)),!n)return new Tn;if(n instanceof Tn)return n;n=n.rgb();var t=n.r/255,e=n.g/255,i=n.b/255,s=Math.min(t,e,i),r=Math.max(t,e,i),o=NaN,a=r-s,c=(r+s)/2;return a?(t===r?o=(e-i)/a+(e<i)*6:e===r?o=(i-t)/a+2:o=(t-e)/a+4,a/=c<.5?r+s:2-r-s,o*=60):a=c>0&&c<1?0:o,new Tn(o,a,c,n.opacity)}function La(n,t,e,i){return arguments.length===1?Rp(n):new Tn(n,t,e,i??1)}function Tn(n,t,e,i){this.h=+n,this.s=+t,this.l=+e,this.opacity=+i}qs(Tn,La,Kr(Ii,{brighter(n){return n=n==null?$s:Math.pow($s,n),new Tn(this.h,this.s,this.l*n,this.opacity)},darker(n){return n=n==null?cs:Math.pow(cs,n),new Tn(this.h,this.s,this.l*n,this.opacity)},rgb(){var n=this.h%360+(this.h<0)*360,t=isNaN(n)||isNaN(this.s)?0:this.s,e=this.l,i=e+(e<.5?e:1-e)*t,s=2*e-i;return new Re(Uh(n>=240?n-240:n+120,s,i),Uh(n,s,i),Uh(n<120?n+240:n-120,s,i),this.opacity)},clamp(){return new Tn(Ep(this.h),Ra(this.s),Ra(this.l),Pa(this.opacity))},displayable(){return(0<=this.s&&this.s<=1||isNaN(this.s))&&0<=this.l&&this.l<=1&&0<=this.opacity&&this.opacity<=1},formatHsl(){let n=Pa(this.opacity);return`${n===1?"hsl(":"hsla("}${Ep(this.h)}, ${Ra(this.s)*100}%, ${Ra(this.l)*100}%${n===1?")":`, ${n})`}`}}));function Ep(n){return n=(n||0)%360,n<0?n+360:n}function Ra(n){return Math.max(0,Math.min(1,n||0))}function Uh(n,t,e){return(n<60?t+(e-t)*n/60:n<180?e:n<240?t+(e-t)*(240-n)/60:t)*255}var Pp=Math.PI/180,Ip=180/Math.PI,Ia=18,Lp=.96422,Np=1,Dp=.82521,Up=4/29,Xs=6/29,Op=3*Xs*Xs,Ay=Xs*Xs*Xs;function Fp(n){if(n instanceof Xn)return new Xn(n.l,n.a,n.b,n.opacity);if(n instanceof ci)return kp(n);n instanceof Re||(n=zh(n));var t=kh(n.r),e=kh(n.g),i=kh(n.b),s=Oh((.2225045*t+.7168786*e+.0606169*i)/Np),r,o;return t===e&&e===i?r=o=s:(r=Oh((.4360747*t+.3850649*e+.1430804*i)/Lp),o=Oh((.0139322*t+.0971045*e+.7141733*i)/Dp)),new Xn(116*s-16,500*(r-s),200*(s-o),n.opacity)}function Bp(n,t,e,i){return arguments.length===1?Fp(n):new Xn(n,t,e,i??1)}function Xn(n,t,e,i){this.l=+n,this.a=+t,this.b=+e,this.opacity=+i}qs(Xn,Bp,Kr(Ii,{brighter(n){return new Xn(this.l+Ia*(n??1),this.a,this.b,this.opacity)},darker(n){return new Xn(this.l-Ia*(n??1),this.a,this.b,this.opacity)},rgb(){var n=(this.l+16)/116,t=isNaN(this.a)?n:n+this.a/500,e=isNaN(this.b)?n:n-this.b/200;return t=Lp*Fh(t),n=Np*Fh(n),e=Dp*Fh(e),new Re(Bh(3.1338561*t-1.6168667*n-.4906146*e),Bh(-.9787684*t+1.9161415*n+.033454*e),Bh(.0719453*t-.2289914*n+1.4052427*e),this.opacity)}}));function Oh(n){return n>Ay?Math.pow(n,1/3):n/Op+Up}function Fh(n){return n>Xs?n*n*n:Op*(n-Up)}function Bh(n){return 255*(n<=.0031308?12.92*n:1.055*Math.pow(n,1/2.4)-.055)}function kh(n){return(n/=255)<=.04045?n/12.92:Math.pow((n+.055)/1.055,2.4)}function Ty(n){if(n instanceof ci)return new ci(n.h,n.c,n.l,n.opacity);if(n instanceof Xn||(n=Fp(n)),n.a===0&&n.b===0)return new ci(NaN,0<n.l&&n.l<100?0:NaN,n.l,n.opacity);var t=Math.atan2(n.b,n.a)*Ip;return new ci(t<0?t+360:t,Math.sqrt(n.a*n.a+n.b*n.b),n.l,n.opacity)}function Na(n,t,e,i){return arguments.length===1?Ty(n):new ci(n,t,e,i??1)}function ci(n,t,e,i){this.h=+n,this.c=+t,this.l=+e,this.opacity=+i}function kp(n){if(isNaN(n.h))return new Xn(n.l,0,0,n.opacity);var t=n.h*Pp;return new Xn(n.l,Math.cos(t)*n.c,Math.sin(t)*n.c,n.opacity)}qs(ci,Na,Kr(Ii,{brighter(n){return new ci(this.h,this.c,this.l+Ia*(n??1),this.opacity)},darker(n){return new ci(this.h,this.c,this.l-Ia*(n??1),this.opacity)},rgb(){return kp(this).rgb()}}));var zp=-.14861,Vh=1.78277,Gh=-.29227,Da=-.90649,Jr=1.97294,Ap=Jr*Da,Tp=Jr*Vh,Cp=Vh*Gh-Da*zp;function Cy(n){if(n instanceof ls)return new ls(n.h,n.s,n.l,n.opacity);n instanceof Re||(n=zh(n));var t=n.r/255,e=n.g/255,i=n.b/255,s=(Cp*i+Ap*t-Tp*e)/(Cp+Ap-Tp),r=i-s,o=(Jr*(e-s)-Gh*r)/Da,a=Math.sqrt(o*o+r*r)/(Jr*s*(1-s)),c=a?Math.atan2(o,r)*Ip-120:NaN;return new ls(c<0?c+360:c,a,s,n.opacity)}function Ua(n,t,e,i){return arguments.length===1?Cy(n):new ls(n,t,e,i??1)}function ls(n,t,e,i){this.h=+n,this.s=+t,this.l=+e,this.opacity=+i}qs(ls,Ua,Kr(Ii,{brighter(n){return n=n==null?$s:Math.pow($s,n),new ls(this.h,this.s,this.l*n,this.opacity)},darker(n){return n=n==null?cs:Math.pow(cs,n),new ls(this.h,this.s,this.l*n,this.opacity)},rgb(){var n=isNaN(this.h)?0:(this.h+120)*Pp,t=+this.l,e=isNaN(this.s)?0:this.s*t*(1-t),i=Math.cos(n),s=Math.sin(n);return new Re(255*(t+e*(zp*i+Vh*s)),255*(t+e*(Gh*i+Da*s)),255*(t+e*(Jr*i)),this.opacity)}}));function Wp(n,t,e,i,s){var r=n*n,o=r*n;return((1-3*n+3*r-o)*t+(4-6*r+3*o)*e+(1+3*n+3*r-3*o)*i+o*s)/6}function Ry(n){var t=n.length-1;return function(e){var i=e<=0?e=0:e>=1?(e=1,t-1):Math.floor(e*t),s=n[i],r=n[i+1],o=i>0?n[i-1]:2*s-r,a=i<t-1?n[i+2]:2*r-s;return Wp((e-i/t)*t,o,s,r,a)}}function Py(n){var t=n.length;return function(e){var i=Math.floor(((e%=1)<0?++e:e)*t),s=n[(i+t-1)%t],r=n[i%t],o=n[(i+1)%t],a=n[(i+2)%t];return Wp((e-i/t)*t,s,r,o,a)}}var Fa=n=>()=>n;function Xp(n,t){return function(e){return n+e*t}}function Iy(n,t,e){return n=Math.pow(n,e),t=Math.pow(t,e)-n,e=1/e,function(i){return Math.pow(n+i*t,e)}}function $h(n,t){var e=t-n;return e?Xp(n,e>180||e<-180?e-360*Math.round(e/360):e):Fa(isNaN(n)?t:n)}function Ly(n){return(n=+n)==1?on:function(t,e){return e-t?Iy(t,e,n):Fa(isNaN(t)?e:t)}}function on(n,t){var e=t-n;return e?Xp(n,e):Fa(isNaN(n)?t:n)}var Vp=(function n(t){var e=Ly(t);function i(s,r){var o=e((s=jr(s)).r,(r=jr(r)).r),a=e(s.g,r.g),c=e(s.b,r.b),l=on(s.opacity,r.opacity);return function(h){return s.r=o(h),s.g=a(h),s.b=c(h),s.opacity=l(h),s+""}}return i.gamma=n,i})(1);function $p(n){return function(t){var e=t.length,i=new Array(e),s=new Array(e),r=new Array(e),o,a;for(o=0;o<e;++o)a=jr(t[o]),i[o]=a.r||0,s[o]=a.g||0,r[o]=a.b||0;return i=n(i),s=n(s),r=n(r),a.opacity=1,function(c){return a.r=i(c),a.g=s(c),a.b=r(c),a+""}}}var eC=$p(Ry),nC=$p(Py);function Ny(n,t){t||(t=[]);var e=n?Math.min(t.length,n.length):0,i=t.slice(),s;return function(r){for(s=0;s<e;++s)i[s]=n[s]*(1-r)+t[s]*r;return i}}function Dy(n){return ArrayBuffer.isView(n)&&!(n instanceof DataView)}function Uy(n,t){var e=t?t.length:0,i=n?Math.min(e,n.length):0,s=new Array(i),r=new Array(e),o;for(o=0;o<i;++o)s[o]=Ba(n[o],t[o]);for(;o<e;++o)r[o]=t[o];return function(a){for(o=0;o<i;++o)r[o]=s[o](a);return r}}function Oy(n,t){var e=new Date;return n=+n,t=+t,function(i){return e.setTime(n*(1-i)+t*i),e}}function Cn(n,t){return n=+n,t=+t,function(e){return n*(1-e)+t*e}}function Fy(n,t){var e={},i={},s;(n===null||typeof n!="object")&&(n={}),(t===null||typeof t!="object")&&(t={});for(s in t)s in n?e[s]=Ba(n[s],t[s]):i[s]=t[s];return function(r){for(s in e)i[s]=e[s](r);return i}}var Wh=/[-+]?(?:\d+\.?\d*|\.?\d+)(?:[eE][-+]?\d+)?/g,Hh=new RegExp(Wh.source,"g");function By(n){return function(){return n}}function ky(n){return function(t){return n(t)+""}}function zy(n,t){var e=Wh.lastIndex=Hh.lastIndex=0,i,s,r,o=-1,a=[],c=[];for(n=n+"",t=t+"";(i=Wh.exec(n))&&(s=Hh.exec(t));)(r=s.index)>e&&(r=t.slice(e,r),a[o]?a[o]+=r:a[++o]=r),(i=i[0])===(s=s[0])?a[o]?a[o]+=s:a[++o]=s:(a[++o]=null,c.push({i:o,x:Cn(i,s)})),e=Hh.lastIndex;return e<t.length&&(r=t.slice(e),a[o]?a[o]+=r:a[++o]=r),a.length<2?c[0]?ky(c[0].x):By(t):(t=c.length,function(l){for(var h=0,u;h<t;++h)a[(u=c[h]).i]=u.x(l);return a.join("")})}function Ba(n,t){var e=typeof t,i;return t==null||e==="boolean"?Fa(t):(e==="number"?Cn:e==="string"?(i=Ys(t))?(t=i,Vp):zy:t instanceof Ys?Vp:t instanceof Date?Oy:Dy(t)?Ny:Array.isArray(t)?Uy:typeof t.valueOf!="function"&&typeof t.toString!="function"||isNaN(t)?Fy:Cn)(n,t)}function qp(n,t){return n=+n,t=+t,function(e){return Math.round(n*(1-e)+t*e)}}var Gp=180/Math.PI,Xh={translateX:0,translateY:0,rotate:0,skewX:0,scaleX:1,scaleY:1};function Yp(n,t,e,i,s,r){var o,a,c;return(o=Math.sqrt(n*n+t*t))&&(n/=o,t/=o),(c=n*e+t*i)&&(e-=n*c,i-=t*c),(a=Math.sqrt(e*e+i*i))&&(e/=a,i/=a,c/=a),n*i<t*e&&(n=-n,t=-t,c=-c,o=-o),{translateX:s,translateY:r,rotate:Math.atan2(t,n)*Gp,skewX:Math.atan(c)*Gp,scaleX:o,scaleY:a}}var Oa;function Vy(n){let t=new(typeof DOMMatrix=="function"?DOMMatrix:WebKitCSSMatrix)(n+"");return t.isIdentity?Xh:Yp(t.a,t.b,t.c,t.d,t.e,t.f)}function Gy(n){return n==null||(Oa||(Oa=document.createElementNS("http://www.w3.org/2000/svg","g")),Oa.setAttribute("transform",n),!(n=Oa.transform.baseVal.consolidate()))?Xh:(n=n.matrix,Yp(n.a,n.b,n.c,n.d,n.e,n.f))}function Zp(n,t,e,i){function s(l){return l.length?l.pop()+" ":""}function r(l,h,u,f,d,g){if(l!==u||h!==f){var _=d.push("translate(",null,t,null,e);g.push({i:_-4,x:Cn(l,u)},{i:_-2,x:Cn(h,f)})}else(u||f)&&d.push("translate("+u+t+f+e)}function o(l,h,u,f){l!==h?(l-h>180?h+=360:h-l>180&&(l+=360),f.push({i:u.push(s(u)+"rotate(",null,i)-2,x:Cn(l,h)})):h&&u.push(s(u)+"rotate("+h+i)}function a(l,h,u,f){l!==h?f.push({i:u.push(s(u)+"skewX(",null,i)-2,x:Cn(l,h)}):h&&u.push(s(u)+"skewX("+h+i)}function c(l,h,u,f,d,g){if(l!==u||h!==f){var _=d.push(s(d)+"scale(",null,",",null,")");g.push({i:_-4,x:Cn(l,u)},{i:_-2,x:Cn(h,f)})}else(u!==1||f!==1)&&d.push(s(d)+"scale("+u+","+f+")")}return function(l,h){var u=[],f=[];return l=n(l),h=n(h),r(l.translateX,l.translateY,h.translateX,h.translateY,u,f),o(l.rotate,h.rotate,u,f),a(l.skewX,h.skewX,u,f),c(l.scaleX,l.scaleY,h.scaleX,h.scaleY,u,f),l=h=null,function(d){for(var g=-1,_=f.length,m;++g<_;)u[(m=f[g]).i]=m.x(d);return u.join("")}}}var iC=Zp(Vy,"px, ","px)","deg)"),sC=Zp(Gy,", ",")",")"),Hy=1e-12;function Hp(n){return((n=Math.exp(n))+1/n)/2}function Wy(n){return((n=Math.exp(n))-1/n)/2}function Xy(n){return((n=Math.exp(2*n))-1)/(n+1)}var rC=(function n(t,e,i){function s(r,o){var a=r[0],c=r[1],l=r[2],h=o[0],u=o[1],f=o[2],d=h-a,g=u-c,_=d*d+g*g,m,p;if(_<Hy)p=Math.log(f/l)/t,m=function(x){return[a+x*d,c+x*g,l*Math.exp(t*x*p)]};else{var y=Math.sqrt(_),b=(f*f-l*l+i*_)/(2*l*e*y),v=(f*f-l*l-i*_)/(2*f*e*y),A=Math.log(Math.sqrt(b*b+1)-b),E=Math.log(Math.sqrt(v*v+1)-v);p=(E-A)/t,m=function(x){var w=x*p,D=Hp(A),R=l/(e*y)*(D*Xy(t*w+A)-Wy(A));return[a+R*d,c+R*g,l*D/Hp(t*w+A)]}}return m.duration=Math.abs(p)*1e3*t/Math.SQRT2,m}return s.rho=function(r){var o=Math.max(.001,+r),a=o*o,c=a*a;return n(o,a,c)},s})(Math.SQRT2,2,4);function Jp(n){return function(t,e){var i=n((t=La(t)).h,(e=La(e)).h),s=on(t.s,e.s),r=on(t.l,e.l),o=on(t.opacity,e.opacity);return function(a){return t.h=i(a),t.s=s(a),t.l=r(a),t.opacity=o(a),t+""}}}var oC=Jp($h),aC=Jp(on);function Kp(n){return function(t,e){var i=n((t=Na(t)).h,(e=Na(e)).h),s=on(t.c,e.c),r=on(t.l,e.l),o=on(t.opacity,e.opacity);return function(a){return t.h=i(a),t.c=s(a),t.l=r(a),t.opacity=o(a),t+""}}}var lC=Kp($h),cC=Kp(on);function jp(n){return(function t(e){e=+e;function i(s,r){var o=n((s=Ua(s)).h,(r=Ua(r)).h),a=on(s.s,r.s),c=on(s.l,r.l),l=on(s.opacity,r.opacity);return function(h){return s.h=o(h),s.s=a(h),s.l=c(Math.pow(h,e)),s.opacity=l(h),s+""}}return i.gamma=t,i})(1)}var hC=jp($h),uC=jp(on);function qh(n){return function(){return n}}function Yh(n){return+n}var Qp=[0,1];function Zs(n){return n}function Zh(n,t){return(t-=n=+n)?function(e){return(e-n)/t}:qh(isNaN(t)?NaN:.5)}function $y(n,t){var e;return n>t&&(e=n,n=t,t=e),function(i){return Math.max(n,Math.min(t,i))}}function qy(n,t,e){var i=n[0],s=n[1],r=t[0],o=t[1];return s<i?(i=Zh(s,i),r=e(o,r)):(i=Zh(i,s),r=e(r,o)),function(a){return r(i(a))}}function Yy(n,t,e){var i=Math.min(n.length,t.length)-1,s=new Array(i),r=new Array(i),o=-1;for(n[i]<n[0]&&(n=n.slice().reverse(),t=t.slice().reverse());++o<i;)s[o]=Zh(n[o],n[o+1]),r[o]=e(t[o],t[o+1]);return function(a){var c=fp(n,a,1,i)-1;return r[c](s[c](a))}}function tm(n,t){return t.domain(n.domain()).range(n.range()).interpolate(n.interpolate()).clamp(n.clamp()).unknown(n.unknown())}function Zy(){var n=Qp,t=Qp,e=Ba,i,s,r,o=Zs,a,c,l;function h(){var f=Math.min(n.length,t.length);return o!==Zs&&(o=$y(n[0],n[f-1])),a=f>2?Yy:qy,c=l=null,u}function u(f){return f==null||isNaN(f=+f)?r:(c||(c=a(n.map(i),t,e)))(i(o(f)))}return u.invert=function(f){return o(s((l||(l=a(t,n.map(i),Cn)))(f)))},u.domain=function(f){return arguments.length?(n=Array.from(f,Yh),h()):n.slice()},u.range=function(f){return arguments.length?(t=Array.from(f),h()):t.slice()},u.rangeRound=function(f){return t=Array.from(f),e=qp,h()},u.clamp=function(f){return arguments.length?(o=f?!0:Zs,h()):o!==Zs},u.interpolate=function(f){return arguments.length?(e=f,h()):e},u.unknown=function(f){return arguments.length?(r=f,u):r},function(f,d){return i=f,s=d,h()}}function Jh(){return Zy()(Zs,Zs)}function Jy(n){return Math.abs(n=Math.round(n))>=1e21?n.toLocaleString("en").replace(/,/g,""):n.toString(10)}function za(n,t){if(!isFinite(n)||n===0)return null;var e=(n=t?n.toExponential(t-1):n.toExponential()).indexOf("e"),i=n.slice(0,e);return[i.length>1?i[0]+i.slice(2):i,+n.slice(e+1)]}function Js(n){return n=za(Math.abs(n)),n?n[1]:NaN}function Ky(n,t){return function(e,i){for(var s=e.length,r=[],o=0,a=n[0],c=0;s>0&&a>0&&(c+a+1>i&&(a=Math.max(1,i-c)),r.push(e.substring(s-=a,s+a)),!((c+=a+1)>i));)a=n[o=(o+1)%n.length];return r.reverse().join(t)}}function jy(n){return function(t){return t.replace(/[0-9]/g,function(e){return n[+e]})}}var Qy=/^(?:(.)?([<>=^]))?([+\-( ])?([$#])?(0)?(\d+)?(,)?(\.\d+)?(~)?([a-z%])?$/i;function Qr(n){if(!(t=Qy.exec(n)))throw new Error("invalid format: "+n);var t;return new Kh({fill:t[1],align:t[2],sign:t[3],symbol:t[4],zero:t[5],width:t[6],comma:t[7],precision:t[8]&&t[8].slice(1),trim:t[9],type:t[10]})}Qr.prototype=Kh.prototype;function Kh(n){this.fill=n.fill===void 0?" ":n.fill+"",this.align=n.align===void 0?">":n.align+"",this.sign=n.sign===void 0?"-":n.sign+"",this.symbol=n.symbol===void 0?"":n.symbol+"",this.zero=!!n.zero,this.width=n.width===void 0?void 0:+n.width,this.comma=!!n.comma,this.precision=n.precision===void 0?void 0:+n.precision,this.trim=!!n.trim,this.type=n.type===void 0?"":n.type+""}Kh.prototype.toString=function(){return this.fill+this.align+this.sign+this.symbol+(this.zero?"0":"")+(this.width===void 0?"":Math.max(1,this.width|0))+(this.comma?",":"")+(this.precision===void 0?"":"."+Math.max(0,this.precision|0))+(this.trim?"~":"")+this.type};function tv(n){t:for(var t=n.length,e=1,i=-1,s;e<t;++e)switch(n[e]){case".":i=s=e;break;case"0":i===0&&(i=e),s=e;break;default:if(!+n[e])break t;i>0&&(i=0);break}return i>0?n.slice(0,i)+n.slice(s+1):n}var Va;function ev(n,t){var e=za(n,t);if(!e)return Va=void 0,n.toPrecision(t);var i=e[0],s=e[1],r=s-(Va=Math.max(-8,Math.min(8,Math.floor(s/3)))*3)+1,o=i.length;return r===o?i:r>o?i+new Array(r-o+1).join("0"):r>0?i.slice(0,r)+"."+i.slice(r):"0."+new Array(1-r).join("0")+za(n,Math.max(0,t+r-1))[0]}function em(n,t){var e=za(n,t);if(!e)return n+"";var i=e[0],s=e[1];return s<0?"0."+new Array(-s).join("0")+i:i.length>s+1?i.slice(0,s+1)+"."+i.slice(s+1):i+new Array(s-i.length+2).join("0")}var nm={"%":(n,t)=>(n*100).toFixed(t),b:n=>Math.round(n).toString(2),c:n=>n+"",d:Jy,e:(n,t)=>n.toExponential(t),f:(n,t)=>n.toFixed(t),g:(n,t)=>n.toPrecision(t),o:n=>Math.round(n).toString(8),p:(n,t)=>em(n*100,t),r:em,s:ev,X:n=>Math.round(n).toString(16).toUpperCase(),x:n=>Math.round(n).toString(16)};function im(n){return n}var sm=Array.prototype.map,rm=["y","z","a","f","p","n","\xB5","m","","k","M","G","T","P","E","Z","Y"];function nv(n){var t=n.grouping===void 0||n.thousands===void 0?im:Ky(sm.call(n.grouping,Number),n.thousands+""),e=n.currency===void 0?"":n.currency[0]+"",i=n.currency===void 0?"":n.currency[1]+"",s=n.decimal===void 0?".":n.decimal+"",r=n.numerals===void 0?im:jy(sm.call(n.numerals,String)),o=n.percent===void 0?"%":n.percent+"",a=n.minus===void 0?"\u2212":n.minus+"",c=n.nan===void 0?"NaN":n.nan+"";function l(u,f){u=Qr(u);var d=u.fill,g=u.align,_=u.sign,m=u.symbol,p=u.zero,y=u.width,b=u.comma,v=u.precision,A=u.trim,E=u.type;E==="n"?(b=!0,E="g"):nm[E]||(v===void 0&&(v=12),A=!0,E="g"),(p||d==="0"&&g==="=")&&(p=!0,d="0",g="=");var x=(f&&f.prefix!==void 0?f.prefix:"")+(m==="$"?e:m==="#"&&/[boxX]/.test(E)?"0"+E.toLowerCase():""),w=(m==="$"?i:/[%p]/.test(E)?o:"")+(f&&f.suffix!==void 0?f.suffix:""),D=nm[E],R=/[defgprs%]/.test(E);v=v===void 0?6:/[gprs]/.test(E)?Math.max(1,Math.min(21,v)):Math.max(0,Math.min(20,v));function L(I){var z=x,C=w,H,q,V;if(E==="c")C=D(I)+C,I="";else{I=+I;var j=I<0||1/I<0;if(I=isNaN(I)?c:D(Math.abs(I),v),A&&(I=tv(I)),j&&+I==0&&_!=="+"&&(j=!1),z=(j?_==="("?_:a:_==="-"||_==="("?"":_)+z,C=(E==="s"&&!isNaN(I)&&Va!==void 0?rm[8+Va/3]:"")+C+(j&&_==="("?")":""),R){for(H=-1,q=I.length;++H<q;)if(V=I.charCodeAt(H),48>V||V>57){C=(V===46?s+I.slice(H+1):I.slice(H))+C,I=I.slice(0,H);break}}}b&&!p&&(I=t(I,1/0));var X=z.length+I.length+C.length,Y=X<y?new Array(y-X+1).join(d):"";switch(b&&p&&(I=t(Y+I,Y.length?y-C.length:1/0),Y=""),g){case"<":I=z+I+C+Y;break;case"=":I=z+Y+I+C;break;case"^":I=Y.slice(0,X=Y.length>>1)+z+I+C+Y.slice(X);break;default:I=Y+z+I+C;break}return r(I)}return L.toString=function(){return u+""},L}function h(u,f){var d=Math.max(-8,Math.min(8,Math.floor(Js(f)/3)))*3,g=Math.pow(10,-d),_=l((u=Qr(u),u.type="f",u),{suffix:rm[8+d/3]});return function(m){return _(g*m)}}return{format:l,formatPrefix:h}}var ka,jh,Qh;iv({thousands:",",grouping:[3],currency:["$",""]});function iv(n){return ka=nv(n),jh=ka.format,Qh=ka.formatPrefix,ka}function om(n){return Math.max(0,-Js(Math.abs(n)))}function am(n,t){return Math.max(0,Math.max(-8,Math.min(8,Math.floor(Js(t)/3)))*3-Js(Math.abs(n)))}function lm(n,t){return n=Math.abs(n),t=Math.abs(t)-n,Math.max(0,Js(t)-Js(n))+1}function tu(n,t,e,i){var s=gp(n,t,e),r;switch(i=Qr(i??",f"),i.type){case"s":{var o=Math.max(Math.abs(n),Math.abs(t));return i.precision==null&&!isNaN(r=am(s,o))&&(i.precision=r),Qh(i,o)}case"":case"e":case"g":case"p":case"r":{i.precision==null&&!isNaN(r=lm(s,Math.max(Math.abs(n),Math.abs(t))))&&(i.precision=r-(i.type==="e"));break}case"f":case"%":{i.precision==null&&!isNaN(r=om(s))&&(i.precision=r-(i.type==="%")*2);break}}return jh(i)}function sv(n){var t=n.domain;return n.ticks=function(e){var i=t();return mp(i[0],i[i.length-1],e??10)},n.tickFormat=function(e,i){var s=t();return tu(s[0],s[s.length-1],e??10,i)},n.nice=function(e){e==null&&(e=10);var i=t(),s=0,r=i.length-1,o=i[s],a=i[r],c,l,h=10;for(a<o&&(l=o,o=a,a=l,l=s,s=r,r=l);h-- >0;){if(l=Ta(o,a,e),l===c)return i[s]=o,i[r]=a,t(i);if(l>0)o=Math.floor(o/l)*l,a=Math.ceil(a/l)*l;else if(l<0)o=Math.ceil(o*l)/l,a=Math.floor(a*l)/l;else break;c=l}return n},n}function hi(){var n=Jh();return n.copy=function(){return tm(n,hi())},_p.apply(n,arguments),sv(n)}function hs(n){return function(){return n}}var to=Math.PI,eu=2*to,us=1e-6,rv=eu-us;function cm(n){this._+=n[0];for(let t=1,e=n.length;t<e;++t)this._+=arguments[t]+n[t]}function ov(n){let t=Math.floor(n);if(!(t>=0))throw new Error(`invalid digits: ${n}`);if(t>15)return cm;let e=10**t;return function(i){this._+=i[0];for(let s=1,r=i.length;s<r;++s)this._+=Math.round(arguments[s]*e)/e+i[s]}}function hm(n,t,e,i){return n===e&&t===i}function av(n){let t=Math.floor(n);if(!(t<=15))return hm;let e=10**t,i=function(s){return Math.round(s*e)};return function(s,r,o,a){return i(s)===i(o)&&i(r)===i(a)}}var Ks=class{constructor(t){this._x0=this._y0=this._x1=this._y1=null,this._="",this._append=t==null?cm:ov(t),this._equal=t==null?hm:av(t)}moveTo(t,e){this._append`M${this._x0=this._x1=+t},${this._y0=this._y1=+e}`}closePath(){this._x1!==null&&(this._x1=this._x0,this._y1=this._y0,this._append`Z`)}lineTo(t,e){this._append`L${this._x1=+t},${this._y1=+e}`}quadraticCurveTo(t,e,i,s){this._append`Q${+t},${+e},${this._x1=+i},${this._y1=+s}`}bezierCurveTo(t,e,i,s,r,o){this._append`C${+t},${+e},${+i},${+s},${this._x1=+r},${this._y1=+o}`}arcTo(t,e,i,s,r){if(t=+t,e=+e,i=+i,s=+s,r=+r,r<0)throw new Error(`negative radius: ${r}`);let o=this._x1,a=this._y1,c=i-t,l=s-e,h=o-t,u=a-e,f=h*h+u*u;if(this._x1===null)this._append`M${this._x1=t},${this._y1=e}`;else if(f>us)if(!(Math.abs(u*c-l*h)>us)||!r)this._append`L${this._x1=t},${this._y1=e}`;else{let d=i-o,g=s-a,_=c*c+l*l,m=d*d+g*g,p=Math.sqrt(_),y=Math.sqrt(f),b=r*Math.tan((to-Math.acos((_+f-m)/(2*p*y)))/2),v=b/y,A=b/p;Math.abs(v-1)>us&&this._append`L${t+v*h},${e+v*u}`,this._append`A${r},${r},0,0,${+(u*d>h*g)},${this._x1=t+A*c},${this._y1=e+A*l}`}}arc(t,e,i,s,r,o){if(t=+t,e=+e,i=+i,o=!!o,i<0)throw new Error(`negative radius: ${i}`);let a=i*Math.cos(s),c=i*Math.sin(s),l=t+a,h=e+c,u=1^o,f=o?s-r:r-s;if(this._x1===null?this._append`M${l},${h}`:(Math.abs(this._x1-l)>us||Math.abs(this._y1-h)>us)&&this._append`L${l},${h}`,!!i){if(f<0&&(f=f%eu+eu),f>rv)this._append`A${i},${i},0,1,${u},${t-a},${e-c}A${i},${i},0,1,${u},${this._x1=l},${this._y1=h}`;else if(f>us){let d=t+i*Math.cos(r),g=e+i*Math.sin(r);if(f>=to&&this._equal(l,h,d,g)){f/=2;let _=s+f;this._append`A${i},${i},0,${+(f>=to)},${u},${t+i*Math.cos(_)},${e+i*Math.sin(_)}`}this._append`A${i},${i},0,${+(f>=to)},${u},${this._x1=d},${this._y1=g}`}}}rect(t,e,i,s){this._append`M${this._x0=this._x1=+t},${this._y0=this._y1=+e}h${i=+i}v${+s}h${-i}Z`}toString(){return this._}};function lv(){return new Ks}lv.prototype=Ks.prototype;function um(n){let t=3;return n.digits=function(e){if(!arguments.length)return t;if(e==null)t=null;else{let i=Math.floor(e);if(!(i>=0))throw new RangeError(`invalid digits: ${e}`);t=i}return n},()=>new Ks(t)}var UC=Array.prototype.slice;function fm(n){return typeof n=="object"&&"length"in n?n:Array.from(n)}function dm(n){this._context=n}dm.prototype={areaStart:function(){this._line=0},areaEnd:function(){this._line=NaN},lineStart:function(){this._point=0},lineEnd:function(){(this._line||this._line!==0&&this._point===1)&&this._context.closePath(),this._line=1-this._line},point:function(n,t){switch(n=+n,t=+t,this._point){case 0:this._point=1,this._line?this._context.lineTo(n,t):this._context.moveTo(n,t);break;case 1:this._point=2;default:this._context.lineTo(n,t);break}}};function pm(n){return new dm(n)}function mm(n){return n[0]}function gm(n){return n[1]}function nu(n,t){var e=hs(!0),i=null,s=pm,r=null,o=um(a);n=typeof n=="function"?n:n===void 0?mm:hs(n),t=typeof t=="function"?t:t===void 0?gm:hs(t);function a(c){var l,h=(c=fm(c)).length,u,f=!1,d;for(i==null&&(r=s(d=o())),l=0;l<=h;++l)!(l<h&&e(u=c[l],l,c))===f&&((f=!f)?r.lineStart():r.lineEnd()),f&&r.point(+n(u,l,c),+t(u,l,c));if(d)return r=null,d+""||null}return a.x=function(c){return arguments.length?(n=typeof c=="function"?c:hs(+c),a):n},a.y=function(c){return arguments.length?(t=typeof c=="function"?c:hs(+c),a):t},a.defined=function(c){return arguments.length?(e=typeof c=="function"?c:hs(!!c),a):e},a.curve=function(c){return arguments.length?(s=c,i!=null&&(r=s(i)),a):s},a.context=function(c){return arguments.length?(c==null?i=r=null:r=s(i=c),a):i},a}var fs={left:38,right:10,top:20,bottom:26},eo=n=>String(Number(n.toPrecision(6))).replace("-","\u2212");function iu(n,t,e,{xLabel:i,title:s,xUnit:r="",yTicks:o=4,yFormat:a=eo}){let c=Ve("g",{class:"axes"});for(let h of e.ticks(o)){let u=e(h);c.append(Ve("path",{class:"grid",d:`M${n.x} ${u}H${n.x+n.width}`})),c.append(Ve("text",{x:n.x-6,y:u+3.5,"text-anchor":"end"},a(h)))}let l=n.y+n.height;if(c.append(Ve("path",{class:"axis",d:`M${n.x} ${l}H${n.x+n.width}`})),i!==void 0){for(let h of t.ticks(Math.max(3,n.width/70))){let u=t(h);c.append(Ve("path",{class:"axis",d:`M${u} ${l}v4`})),c.append(Ve("text",{x:u,y:l+15,"text-anchor":"middle"},eo(h)+r))}i&&c.append(Ve("text",{class:"label",x:n.x+n.width,y:l-5,"text-anchor":"end"},i))}return c.append(Ve("text",{class:"title",x:n.x,y:n.y-7},s)),c}function su(n,t,e){let i=nu().defined(([s,r])=>Number.isFinite(s)&&Number.isFinite(r)).x(([s])=>Math.round(t(s)*10)/10).y(([,s])=>Math.round(e(s)*10)/10);return n.map(({points:s,colour:r,dashes:o,width:a})=>Ve("path",{class:"curve",d:i(s)??"",stroke:r,"stroke-width":a,...o?{"stroke-dasharray":o.map(c=>c*a).join(" ")}:{}}))}function _m(n,t){let e=Ve("svg",{role:"img","aria-label":t});return n.append(e),{root:e,size(){let[i,s]=[Math.max(200,n.clientWidth),Math.max(120,n.clientHeight)];return e.setAttribute("viewBox",`0 0 ${i} ${s}`),{x:fs.left,y:fs.top,width:i-fs.left-fs.right,height:s-fs.top-fs.bottom}}}}function xm(n){let{root:t,size:e}=_m(n,"Angle of reflection against angle of incidence under each law");return{update(i,s,r,o){let a=e(),c=[...i.flatMap(({points:_})=>_.map(([,m])=>m)),...s.map(({reflection:_})=>_)].filter(Number.isFinite),l=Math.min(0,...c),h=hi([0,90],[a.x,a.x+a.width]),u=hi([Math.max(-90,Math.floor(l/15)*15),90],[a.y+a.height,a.y]),f=s.map(({incidence:_,reflection:m,stage:p})=>Ve("circle",{class:`measured ${p==="after_wall"?"early":""}`,cx:h(_).toFixed(1),cy:u(m).toFixed(1),r:2.6})),d=r===null?[]:[Ve("path",{class:"cursor",d:`M${h(r)} ${a.y}V${a.y+a.height}`})],g=r===null?[]:o.map(({colour:_,y:m})=>Ve("circle",{class:"now",cx:h(r).toFixed(1),cy:u(m).toFixed(1),r:3.4,fill:_}));t.replaceChildren(iu(a,h,u,{title:"reflection against incidence",xLabel:"from the wall\u2019s normal",xUnit:"\xB0",yFormat:_=>`${eo(_)}\xB0`}),Ve("path",{class:"same",d:`M${h(0)} ${u(0)}L${h(90)} ${u(90)}`}),...f,...su(i,h,u),...d,...g)}}}function ym(n,t){let{root:e,size:i}=_m(n,"Energy kept and height of the ball over time under each law"),s=Ve("path",{class:"cursor"}),r=1,o=i(),a=l=>{let h=e.getBoundingClientRect(),u=(l.clientX-h.left)/h.width*(o.x+o.width+fs.right);t(Math.max(0,Math.min(1,(u-o.x)/o.width))*r)};return e.addEventListener("pointerdown",l=>{e.setPointerCapture(l.pointerId),a(l)}),e.addEventListener("pointermove",l=>{l.buttons&&a(l)}),{place:l=>{let h=o.x+o.width*Math.min(l,r)/r;s.setAttribute("d",`M${h.toFixed(1)} ${o.y}V${o.y+o.height}`)},update(l,h,u){o=i(),r=u;let f=Math.max(0,...h.flatMap(({points:b})=>b.map(([,v])=>v))),d=f>.001,g={...o,height:d?(o.height-24)*.52:o.height},_=hi([0,u],[o.x,o.x+o.width]),m=Math.max(1,...l.flatMap(({points:b})=>b.map(([,v])=>v))),p=hi([0,m*1.02],[g.y+g.height,g.y]),y=[iu(g,_,p,{title:"energy kept",yTicks:d?2:4,yFormat:b=>`${eo(100*b)} %`,...d?{}:{xLabel:"time, s"}}),...su(l,_,p)];if(d){let b={...o,y:g.y+g.height+24,height:o.height-g.height-24},v=f>500,A=hi([0,f*1.05],[b.y+b.height,b.y]),E=x=>eo(v?x/1e3:x);y.push(iu(b,_,A,{title:`height, ${v?"m":"mm"}`,xLabel:"time, s",yTicks:2,yFormat:E}),...su(h,_,A))}e.replaceChildren(...y,s)}}}var vm=[1/1e3,1/300,1/100,1/30,1/10,1/4,1/2,1,2,4],ru=1e4;function bm(n,t){let e=Zt("play"),i=Zt("time"),s=Zt("speed");i.max=String(ru);for(let h of vm){let u=document.createElement("option");u.value=String(h),u.textContent=h<1?`1/${Math.round(1/h)} \xD7`:`${h} \xD7`,s.append(u)}let r=null;function o(h){if(!n.state.playing){r=null;return}let{until:u}=t(),f=r===null?0:Math.min((h-r)/1e3,.1);r=h;let d=Math.min(n.state.t+f*n.state.speed,u);n.change({t:d,playing:d<u},"time"),requestAnimationFrame(o)}function a(h){if(h===n.state.playing)return;let u=h&&n.state.t>=t().until*(1-1e-9)?0:n.state.t;r=null,n.change({playing:h,t:u},"time"),h&&requestAnimationFrame(o)}function c(h){n.change({t:Math.max(0,Math.min(h,t().until)),playing:!1},"time")}function l(h){let{events:u,until:f}=t(),d=n.state.t,g=1e-9*Math.max(f,.001),_=u.map(({t:p})=>p).filter(p=>p<=f),m=h>0?_.find(p=>p>d+g):_.findLast(p=>p<d-g);c(m??(h>0?f:0))}return e.onclick=()=>a(!n.state.playing),Zt("next").onclick=()=>l(1),Zt("previous").onclick=()=>l(-1),Zt("restart").onclick=()=>c(0),i.oninput=()=>c(Number(i.value)/ru*t().until),s.onchange=()=>n.change({speed:Number(s.value)},"time"),addEventListener("keydown",h=>{let u=h.target;if(h.ctrlKey||h.metaKey||h.altKey||/^(INPUT|SELECT|TEXTAREA)$/.test(u.tagName))return;let f=t().until/200,d={" ":()=>a(!n.state.playing),ArrowLeft:()=>c(n.state.t-f*(h.shiftKey?10:1)),ArrowRight:()=>c(n.state.t+f*(h.shiftKey?10:1)),",":()=>l(-1),".":()=>l(1),Home:()=>c(0),End:()=>c(t().until)};h.key===" "&&u.tagName==="BUTTON"||Object.hasOwn(d,h.key)&&(h.preventDefault(),d[h.key]())}),{setPlaying:a,seek:c,update(){let{until:h,events:u}=t(),{t:f,playing:d}=n.state;i.value=String(Math.round(f/h*ru)),i.setAttribute("aria-valuetext",Gr(f)),Zt("clock").textContent=`${Gr(f)} of ${Gr(h)}`,e.textContent=d?"Pause":"Play",e.setAttribute("aria-pressed",String(d)),s.value=String(vm.reduce((m,p)=>Math.abs(Math.log(p/n.state.speed))<Math.abs(Math.log(m/n.state.speed))?p:m));let g=1e-9*Math.max(h,.001),_=u.findLast(m=>m.t<=f+g);Zt("event").textContent=_?`${Gr(_.t)}: ${_.text}`:""}}}var Ga=class{constructor(t){this.state=t,this.listeners=[],this.past=[],this.future=[]}listen(t){this.listeners.push(t)}change(t,...e){Object.assign(this.state,t);let i=new Set(e);for(let s of this.listeners)s(i)}remember(){let t=JSON.stringify(this.state.scene);this.past[this.past.length-1]!==t&&(this.past.push(t),this.past.length>100&&this.past.shift(),this.future=[])}#t(t,e){let i=JSON.stringify(this.state.scene),s=t.pop();for(;s===i;)s=t.pop();if(s===void 0)return;e.push(i);let r=JSON.parse(s),o=Math.min(this.state.ball,r.balls.length-1);this.change({scene:r,ball:o,wall:Math.min(this.state.wall,r.walls.length-1)},"scene","laws")}undo(){this.#t(this.past,this.future)}redo(){this.#t(this.future,this.past)}};var Wi={LEFT:0,MIDDLE:1,RIGHT:2,ROTATE:0,DOLLY:1,PAN:2},Xi={ROTATE:0,PAN:1,DOLLY_PAN:2,DOLLY_ROTATE:3},eg=0,Fu=1,ng=2;var Oo=1,ig=2,Er=3,$i=0,De=1,Sn=2,bs=0,Ar=1,Bu=2,ku=3,zu=4,sg=5;var Ms=100,rg=101,og=102,ag=103,lg=104,cg=200,hg=201,ug=202,fg=203,Vu=204,Gu=205,dg=206,pg=207,mg=208,gg=209,_g=210,xg=211,yg=212,vg=213,bg=214,_l=0,xl=1,yl=2,mr=3,vl=4,bl=5,Ml=6,Sl=7,Kl=0,Mg=1,Sg=2,Zn=0,Hu=1,Wu=2,Xu=3,$u=4,qu=5,Yu=6,Zu=7;var Ju=300,Ss=301,Tr=302,jl=303,Ql=304,wl=1e3,qn=1001,El=1002,Ie=1003,wg=1004;var Fo=1005;var Qe=1006,tc=1007;var wi=1008;var an=1009,Ku=1010,ju=1011,Cr=1012,ec=1013,Fn=1014,Bn=1015,kn=1016,nc=1017,ic=1018,ws=1020,Qu=35902,tf=35899,ef=1021,nf=1022,zn=1023,xi=1026,Ei=1027,sf=1028,sc=1029,qi=1030,rc=1031;var oc=1033,Bo=33776,ko=33777,zo=33778,Vo=33779,ac=35840,lc=35841,cc=35842,hc=35843,uc=36196,fc=37492,dc=37496,pc=37488,mc=37489,Go=37490,gc=37491,_c=37808,xc=37809,yc=37810,vc=37811,bc=37812,Mc=37813,Sc=37814,wc=37815,Ec=37816,Ac=37817,Tc=37818,Cc=37819,Rc=37820,Pc=37821,Ic=36492,Lc=36494,Nc=36495,Dc=36283,Uc=36284,Ho=36285,Oc=36286;var co=2300,Al=2301,ml=2302,Ru=2303,Pu=2400,Iu=2401,Lu=2402;var Eg=3200;var Fc=0,Ag=1,Ai="",Je="srgb",ho="srgb-linear",uo="linear",te="srgb";var gl=7680;var Tg=519,Cg=512,Rg=513,Pg=514,rf=515,Ig=516,Lg=517,of=518,af=519,lf=35044;var cf="300 es",bn=2e3,gr=2001;function cv(n){for(let t=n.length-1;t>=0;--t)if(n[t]>=65535)return!0;return!1}function hv(n){return ArrayBuffer.isView(n)&&!(n instanceof DataView)}function fo(n){return document.createElementNS("http://www.w3.org/1999/xhtml",n)}function Ng(){let n=fo("canvas");return n.style.display="block",n}var Mm={},_r=null;function po(...n){let t="THREE."+n.shift();_r?_r("log",t,...n):console.log(t,...n)}function Dg(n){let t=n[0];if(typeof t=="string"&&t.startsWith("TSL:")){let e=n[1];e&&e.isStackTrace?n[0]+=" "+e.getLocation():n[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return n}function It(...n){n=Dg(n);let t="THREE."+n.shift();if(_r)_r("warn",t,...n);else{let e=n[0];e&&e.isStackTrace?console.warn(e.getError(t)):console.warn(t,...n)}}function Nt(...n){n=Dg(n);let t="THREE."+n.shift();if(_r)_r("error",t,...n);else{let e=n[0];e&&e.isStackTrace?console.error(e.getError(t)):console.error(t,...n)}}function ao(...n){let t=n.join(" ");t in Mm||(Mm[t]=!0,It(...n))}function Ug(n,t,e){return new Promise(function(i,s){function r(){switch(n.clientWaitSync(t,n.SYNC_FLUSH_COMMANDS_BIT,0)){case n.WAIT_FAILED:s();break;case n.TIMEOUT_EXPIRED:setTimeout(r,e);break;default:i()}}setTimeout(r,e)})}var Og={[_l]:_l,[yl]:Ml,[vl]:vl,[mr]:bl,[xl]:xl,[Ml]:yl,[Sl]:Sl,[bl]:mr},Nn=class{addEventListener(t,e){this._listeners===void 0&&(this._listeners={});let i=this._listeners;i[t]===void 0&&(i[t]=[]),i[t].indexOf(e)===-1&&i[t].push(e)}hasEventListener(t,e){let i=this._listeners;return i===void 0?!1:i[t]!==void 0&&i[t].indexOf(e)!==-1}removeEventListener(t,e){let i=this._listeners;if(i===void 0)return;let s=i[t];if(s!==void 0){let r=s.indexOf(e);r!==-1&&s.splice(r,1)}}dispatchEvent(t){let e=this._listeners;if(e===void 0)return;let i=e[t.type];if(i!==void 0){t.target=this;let s=i.slice(0);for(let r=0,o=s.length;r<o;r++)s[r].call(this,t);t.target=null}}},He=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"],Sm=1234567,dr=Math.PI/180,xr=180/Math.PI;function Yi(){let n=Math.random()*4294967295|0,t=Math.random()*4294967295|0,e=Math.random()*4294967295|0,i=Math.random()*4294967295|0;return(He[n&255]+He[n>>8&255]+He[n>>16&255]+He[n>>24&255]+"-"+He[t&255]+He[t>>8&255]+"-"+He[t>>16&15|64]+He[t>>24&255]+"-"+He[e&63|128]+He[e>>8&255]+"-"+He[e>>16&255]+He[e>>24&255]+He[i&255]+He[i>>8&255]+He[i>>16&255]+He[i>>24&255]).toLowerCase()}function Bt(n,t,e){return Math.max(t,Math.min(e,n))}function hf(n,t){return(n%t+t)%t}function uv(n,t,e,i,s){return i+(n-t)*(s-i)/(e-t)}function fv(n,t,e){return n!==t?(e-n)/(t-n):0}function lo(n,t,e){return(1-e)*n+e*t}function dv(n,t,e,i){return lo(n,t,1-Math.exp(-e*i))}function pv(n,t=1){return t-Math.abs(hf(n,t*2)-t)}function mv(n,t,e){return n<=t?0:n>=e?1:(n=(n-t)/(e-t),n*n*(3-2*n))}function gv(n,t,e){return n<=t?0:n>=e?1:(n=(n-t)/(e-t),n*n*n*(n*(n*6-15)+10))}function _v(n,t){return n+Math.floor(Math.random()*(t-n+1))}function xv(n,t){return n+Math.random()*(t-n)}function yv(n){return n*(.5-Math.random())}function vv(n){n!==void 0&&(Sm=n);let t=Sm+=1831565813;return t=Math.imul(t^t>>>15,t|1),t^=t+Math.imul(t^t>>>7,t|61),((t^t>>>14)>>>0)/4294967296}function bv(n){return n*dr}function Mv(n){return n*xr}function Sv(n){return n>0&&Number.isInteger(n)&&2**Math.round(Math.log2(n))===n}function wv(n){return Math.pow(2,Math.ceil(Math.log(n)/Math.LN2))}function uf(n){return Math.pow(2,Math.floor(Math.log(n)/Math.LN2))}function Ev(n,t,e,i,s){let r=Math.cos,o=Math.sin,a=r(e/2),c=o(e/2),l=r((t+i)/2),h=o((t+i)/2),u=r((t-i)/2),f=o((t-i)/2),d=r((i-t)/2),g=o((i-t)/2);switch(s){case"XYX":n.set(a*h,c*u,c*f,a*l);break;case"YZY":n.set(c*f,a*h,c*u,a*l);break;case"ZXZ":n.set(c*u,c*f,a*h,a*l);break;case"XZX":n.set(a*h,c*g,c*d,a*l);break;case"YXY":n.set(c*d,a*h,c*g,a*l);break;case"ZYZ":n.set(c*g,c*d,a*h,a*l);break;default:It("MathUtils: .setQuaternionFromProperEuler() encountered an unknown order: "+s)}}function Bc(n){switch(n.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function ff(n,t){if(t.constructor===Float32Array)return n;let e=Bc(t);if(e===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(n/e,-1)}function df(n,t){if(t.constructor===Float32Array)return n;let e=Bc(t);if(e===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(n*e)}var Wo={DEG2RAD:dr,RAD2DEG:xr,generateUUID:Yi,clamp:Bt,euclideanModulo:hf,mapLinear:uv,inverseLerp:fv,lerp:lo,damp:dv,pingpong:pv,smoothstep:mv,smootherstep:gv,randInt:_v,randFloat:xv,randFloatSpread:yv,seededRandom:vv,degToRad:bv,radToDeg:Mv,isPowerOfTwo:Sv,ceilPowerOfTwo:wv,floorPowerOfTwo:uf,setQuaternionFromProperEuler:Ev,normalize:df,denormalize:ff},Ct=class{static{this.prototype.isVector2=!0}constructor(t=0,e=0){this.x=t,this.y=e}get width(){return this.x}set width(t){this.x=t}get height(){return this.y}set height(t){this.y=t}set(t,e){return this.x=t,this.y=e,this}setScalar(t){return this.x=t,this.y=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;default:throw new Error("THREE.Vector2: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y)}copy(t){return this.x=t.x,this.y=t.y,this}add(t){return this.x+=t.x,this.y+=t.y,this}addScalar(t){return this.x+=t,this.y+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this}subScalar(t){return this.x-=t,this.y-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this}multiply(t){return this.x*=t.x,this.y*=t.y,this}multiplyScalar(t){return this.x*=t,this.y*=t,this}divide(t){return this.x/=t.x,this.y/=t.y,this}divideScalar(t){return this.multiplyScalar(1/t)}applyMatrix3(t){let e=this.x,i=this.y,s=t.elements;return this.x=s[0]*e+s[3]*i+s[6],this.y=s[1]*e+s[4]*i+s[7],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this}clamp(t,e){return this.x=Bt(this.x,t.x,e.x),this.y=Bt(this.y,t.y,e.y),this}clampScalar(t,e){return this.x=Bt(this.x,t,e),this.y=Bt(this.y,t,e),this}clampLength(t,e){let i=this.length();return this.divideScalar(i||1).multiplyScalar(Bt(i,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(t){return this.x*t.x+this.y*t.y}cross(t){return this.x*t.y-this.y*t.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let i=this.dot(t)/e;return Math.acos(Bt(i,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,i=this.y-t.y;return e*e+i*i}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this}lerpVectors(t,e,i){return this.x=t.x+(e.x-t.x)*i,this.y=t.y+(e.y-t.y)*i,this}equals(t){return t.x===this.x&&t.y===this.y}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this}rotateAround(t,e){let i=Math.cos(e),s=Math.sin(e),r=this.x-t.x,o=this.y-t.y;return this.x=r*i-o*s+t.x,this.y=r*s+o*i+t.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}},Ne=class{constructor(t=0,e=0,i=0,s=1){this.isQuaternion=!0,this._x=t,this._y=e,this._z=i,this._w=s}static slerpFlat(t,e,i,s,r,o,a){let c=i[s+0],l=i[s+1],h=i[s+2],u=i[s+3],f=r[o+0],d=r[o+1],g=r[o+2],_=r[o+3];if(u!==_||c!==f||l!==d||h!==g){let m=c*f+l*d+h*g+u*_;m<0&&(f=-f,d=-d,g=-g,_=-_,m=-m);let p=1-a;if(m<.9995){let y=Math.acos(m),b=Math.sin(y);p=Math.sin(p*y)/b,a=Math.sin(a*y)/b,c=c*p+f*a,l=l*p+d*a,h=h*p+g*a,u=u*p+_*a}else{c=c*p+f*a,l=l*p+d*a,h=h*p+g*a,u=u*p+_*a;let y=1/Math.sqrt(c*c+l*l+h*h+u*u);c*=y,l*=y,h*=y,u*=y}}t[e]=c,t[e+1]=l,t[e+2]=h,t[e+3]=u}static multiplyQuaternionsFlat(t,e,i,s,r,o){let a=i[s],c=i[s+1],l=i[s+2],h=i[s+3],u=r[o],f=r[o+1],d=r[o+2],g=r[o+3];return t[e]=a*g+h*u+c*d-l*f,t[e+1]=c*g+h*f+l*u-a*d,t[e+2]=l*g+h*d+a*f-c*u,t[e+3]=h*g-a*u-c*f-l*d,t}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get w(){return this._w}set w(t){this._w=t,this._onChangeCallback()}set(t,e,i,s){return this._x=t,this._y=e,this._z=i,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(t){return this._x=t.x,this._y=t.y,this._z=t.z,this._w=t.w,this._onChangeCallback(),this}setFromEuler(t,e=!0){let i=t._x,s=t._y,r=t._z,o=t._order,a=Math.cos,c=Math.sin,l=a(i/2),h=a(s/2),u=a(r/2),f=c(i/2),d=c(s/2),g=c(r/2);switch(o){case"XYZ":this._x=f*h*u+l*d*g,this._y=l*d*u-f*h*g,this._z=l*h*g+f*d*u,this._w=l*h*u-f*d*g;break;case"YXZ":this._x=f*h*u+l*d*g,this._y=l*d*u-f*h*g,this._z=l*h*g-f*d*u,this._w=l*h*u+f*d*g;break;case"ZXY":this._x=f*h*u-l*d*g,this._y=l*d*u+f*h*g,this._z=l*h*g+f*d*u,this._w=l*h*u-f*d*g;break;case"ZYX":this._x=f*h*u-l*d*g,this._y=l*d*u+f*h*g,this._z=l*h*g-f*d*u,this._w=l*h*u+f*d*g;break;case"YZX":this._x=f*h*u+l*d*g,this._y=l*d*u+f*h*g,this._z=l*h*g-f*d*u,this._w=l*h*u-f*d*g;break;case"XZY":this._x=f*h*u-l*d*g,this._y=l*d*u-f*h*g,this._z=l*h*g+f*d*u,this._w=l*h*u+f*d*g;break;default:It("Quaternion: .setFromEuler() encountered an unknown order: "+o)}return e===!0&&this._onChangeCallback(),this}setFromAxisAngle(t,e){let i=e/2,s=Math.sin(i);return this._x=t.x*s,this._y=t.y*s,this._z=t.z*s,this._w=Math.cos(i),this._onChangeCallback(),this}setFromRotationMatrix(t){let e=t.elements,i=e[0],s=e[4],r=e[8],o=e[1],a=e[5],c=e[9],l=e[2],h=e[6],u=e[10],f=i+a+u;if(f>0){let d=.5/Math.sqrt(f+1);this._w=.25/d,this._x=(h-c)*d,this._y=(r-l)*d,this._z=(o-s)*d}else if(i>a&&i>u){let d=2*Math.sqrt(1+i-a-u);this._w=(h-c)/d,this._x=.25*d,this._y=(s+o)/d,this._z=(r+l)/d}else if(a>u){let d=2*Math.sqrt(1+a-i-u);this._w=(r-l)/d,this._x=(s+o)/d,this._y=.25*d,this._z=(c+h)/d}else{let d=2*Math.sqrt(1+u-i-a);this._w=(o-s)/d,this._x=(r+l)/d,this._y=(c+h)/d,this._z=.25*d}return this._onChangeCallback(),this}setFromUnitVectors(t,e){let i=t.dot(e)+1;return i<1e-8?(i=0,Math.abs(t.x)>Math.abs(t.z)?(this._x=-t.y,this._y=t.x,this._z=0,this._w=i):(this._x=0,this._y=-t.z,this._z=t.y,this._w=i)):(this._x=t.y*e.z-t.z*e.y,this._y=t.z*e.x-t.x*e.z,this._z=t.x*e.y-t.y*e.x,this._w=i),this.normalize()}angleTo(t){return 2*Math.acos(Math.abs(Bt(this.dot(t),-1,1)))}rotateTowards(t,e){let i=this.angleTo(t);if(i===0)return this;let s=Math.min(1,e/i);return this.slerp(t,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(t){return this._x*t._x+this._y*t._y+this._z*t._z+this._w*t._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let t=this.length();return t===0?(this._x=0,this._y=0,this._z=0,this._w=1):(t=1/t,this._x=this._x*t,this._y=this._y*t,this._z=this._z*t,this._w=this._w*t),this._onChangeCallback(),this}multiply(t){return this.multiplyQuaternions(this,t)}premultiply(t){return this.multiplyQuaternions(t,this)}multiplyQuaternions(t,e){let i=t._x,s=t._y,r=t._z,o=t._w,a=e._x,c=e._y,l=e._z,h=e._w;return this._x=i*h+o*a+s*l-r*c,this._y=s*h+o*c+r*a-i*l,this._z=r*h+o*l+i*c-s*a,this._w=o*h-i*a-s*c-r*l,this._onChangeCallback(),this}slerp(t,e){let i=t._x,s=t._y,r=t._z,o=t._w,a=this.dot(t);a<0&&(i=-i,s=-s,r=-r,o=-o,a=-a);let c=1-e;if(a<.9995){let l=Math.acos(a),h=Math.sin(l);c=Math.sin(c*l)/h,e=Math.sin(e*l)/h,this._x=this._x*c+i*e,this._y=this._y*c+s*e,this._z=this._z*c+r*e,this._w=this._w*c+o*e,this._onChangeCallback()}else this._x=this._x*c+i*e,this._y=this._y*c+s*e,this._z=this._z*c+r*e,this._w=this._w*c+o*e,this.normalize();return this}slerpQuaternions(t,e,i){return this.copy(t).slerp(e,i)}random(){let t=2*Math.PI*Math.random(),e=2*Math.PI*Math.random(),i=Math.random(),s=Math.sqrt(1-i),r=Math.sqrt(i);return this.set(s*Math.sin(t),s*Math.cos(t),r*Math.sin(e),r*Math.cos(e))}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._w===this._w}fromArray(t,e=0){return this._x=t[e],this._y=t[e+1],this._z=t[e+2],this._w=t[e+3],this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._w,t}fromBufferAttribute(t,e){return this._x=t.getX(e),this._y=t.getY(e),this._z=t.getZ(e),this._w=t.getW(e),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},N=class{static{this.prototype.isVector3=!0}constructor(t=0,e=0,i=0){this.x=t,this.y=e,this.z=i}set(t,e,i){return i===void 0&&(i=this.z),this.x=t,this.y=e,this.z=i,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;default:throw new Error("THREE.Vector3: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this}multiplyVectors(t,e){return this.x=t.x*e.x,this.y=t.y*e.y,this.z=t.z*e.z,this}applyEuler(t){return this.applyQuaternion(wm.setFromEuler(t))}applyAxisAngle(t,e){return this.applyQuaternion(wm.setFromAxisAngle(t,e))}applyMatrix3(t){let e=this.x,i=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[3]*i+r[6]*s,this.y=r[1]*e+r[4]*i+r[7]*s,this.z=r[2]*e+r[5]*i+r[8]*s,this}applyNormalMatrix(t){return this.applyMatrix3(t).normalize()}applyMatrix4(t){let e=this.x,i=this.y,s=this.z,r=t.elements,o=1/(r[3]*e+r[7]*i+r[11]*s+r[15]);return this.x=(r[0]*e+r[4]*i+r[8]*s+r[12])*o,this.y=(r[1]*e+r[5]*i+r[9]*s+r[13])*o,this.z=(r[2]*e+r[6]*i+r[10]*s+r[14])*o,this}applyQuaternion(t){let e=this.x,i=this.y,s=this.z,r=t.x,o=t.y,a=t.z,c=t.w,l=2*(o*s-a*i),h=2*(a*e-r*s),u=2*(r*i-o*e);return this.x=e+c*l+o*u-a*h,this.y=i+c*h+a*l-r*u,this.z=s+c*u+r*h-o*l,this}project(t){return this.applyMatrix4(t.matrixWorldInverse).applyMatrix4(t.projectionMatrix)}unproject(t){return this.applyMatrix4(t.projectionMatrixInverse).applyMatrix4(t.matrixWorld)}transformDirection(t){let e=this.x,i=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[4]*i+r[8]*s,this.y=r[1]*e+r[5]*i+r[9]*s,this.z=r[2]*e+r[6]*i+r[10]*s,this.normalize()}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this}divideScalar(t){return this.multiplyScalar(1/t)}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this}clamp(t,e){return this.x=Bt(this.x,t.x,e.x),this.y=Bt(this.y,t.y,e.y),this.z=Bt(this.z,t.z,e.z),this}clampScalar(t,e){return this.x=Bt(this.x,t,e),this.y=Bt(this.y,t,e),this.z=Bt(this.z,t,e),this}clampLength(t,e){let i=this.length();return this.divideScalar(i||1).multiplyScalar(Bt(i,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this}lerpVectors(t,e,i){return this.x=t.x+(e.x-t.x)*i,this.y=t.y+(e.y-t.y)*i,this.z=t.z+(e.z-t.z)*i,this}cross(t){return this.crossVectors(this,t)}crossVectors(t,e){let i=t.x,s=t.y,r=t.z,o=e.x,a=e.y,c=e.z;return this.x=s*c-r*a,this.y=r*o-i*c,this.z=i*a-s*o,this}projectOnVector(t){let e=t.lengthSq();if(e===0)return this.set(0,0,0);let i=t.dot(this)/e;return this.copy(t).multiplyScalar(i)}projectOnPlane(t){return ou.copy(this).projectOnVector(t),this.sub(ou)}reflect(t){return this.sub(ou.copy(t).multiplyScalar(2*this.dot(t)))}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let i=this.dot(t)/e;return Math.acos(Bt(i,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,i=this.y-t.y,s=this.z-t.z;return e*e+i*i+s*s}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)+Math.abs(this.z-t.z)}setFromSpherical(t){return this.setFromSphericalCoords(t.radius,t.phi,t.theta)}setFromSphericalCoords(t,e,i){let s=Math.sin(e)*t;return this.x=s*Math.sin(i),this.y=Math.cos(e)*t,this.z=s*Math.cos(i),this}setFromCylindrical(t){return this.setFromCylindricalCoords(t.radius,t.theta,t.y)}setFromCylindricalCoords(t,e,i){return this.x=t*Math.sin(e),this.y=i,this.z=t*Math.cos(e),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this}setFromMatrixScale(t){let e=this.setFromMatrixColumn(t,0).length(),i=this.setFromMatrixColumn(t,1).length(),s=this.setFromMatrixColumn(t,2).length();return this.x=e,this.y=i,this.z=s,this}setFromMatrixColumn(t,e){return this.fromArray(t.elements,e*4)}setFromMatrix3Column(t,e){return this.fromArray(t.elements,e*3)}setFromEuler(t){return this.x=t._x,this.y=t._y,this.z=t._z,this}setFromColor(t){return this.x=t.r,this.y=t.g,this.z=t.b,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let t=Math.random()*Math.PI*2,e=Math.random()*2-1,i=Math.sqrt(1-e*e);return this.x=i*Math.cos(t),this.y=e,this.z=i*Math.sin(t),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}},ou=new N,wm=new Ne,Ut=class{static{this.prototype.isMatrix3=!0}constructor(t,e,i,s,r,o,a,c,l){this.elements=[1,0,0,0,1,0,0,0,1],t!==void 0&&this.set(t,e,i,s,r,o,a,c,l)}set(t,e,i,s,r,o,a,c,l){let h=this.elements;return h[0]=t,h[1]=s,h[2]=a,h[3]=e,h[4]=r,h[5]=c,h[6]=i,h[7]=o,h[8]=l,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(t){let e=this.elements,i=t.elements;return e[0]=i[0],e[1]=i[1],e[2]=i[2],e[3]=i[3],e[4]=i[4],e[5]=i[5],e[6]=i[6],e[7]=i[7],e[8]=i[8],this}extractBasis(t,e,i){return t.setFromMatrix3Column(this,0),e.setFromMatrix3Column(this,1),i.setFromMatrix3Column(this,2),this}setFromMatrix4(t){let e=t.elements;return this.set(e[0],e[4],e[8],e[1],e[5],e[9],e[2],e[6],e[10]),this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let i=t.elements,s=e.elements,r=this.elements,o=i[0],a=i[3],c=i[6],l=i[1],h=i[4],u=i[7],f=i[2],d=i[5],g=i[8],_=s[0],m=s[3],p=s[6],y=s[1],b=s[4],v=s[7],A=s[2],E=s[5],x=s[8];return r[0]=o*_+a*y+c*A,r[3]=o*m+a*b+c*E,r[6]=o*p+a*v+c*x,r[1]=l*_+h*y+u*A,r[4]=l*m+h*b+u*E,r[7]=l*p+h*v+u*x,r[2]=f*_+d*y+g*A,r[5]=f*m+d*b+g*E,r[8]=f*p+d*v+g*x,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[3]*=t,e[6]*=t,e[1]*=t,e[4]*=t,e[7]*=t,e[2]*=t,e[5]*=t,e[8]*=t,this}determinant(){let t=this.elements,e=t[0],i=t[1],s=t[2],r=t[3],o=t[4],a=t[5],c=t[6],l=t[7],h=t[8];return e*o*h-e*a*l-i*r*h+i*a*c+s*r*l-s*o*c}invert(){let t=this.elements,e=t[0],i=t[1],s=t[2],r=t[3],o=t[4],a=t[5],c=t[6],l=t[7],h=t[8],u=h*o-a*l,f=a*c-h*r,d=l*r-o*c,g=e*u+i*f+s*d;if(g===0)return this.set(0,0,0,0,0,0,0,0,0);let _=1/g;return t[0]=u*_,t[1]=(s*l-h*i)*_,t[2]=(a*i-s*o)*_,t[3]=f*_,t[4]=(h*e-s*c)*_,t[5]=(s*r-a*e)*_,t[6]=d*_,t[7]=(i*c-l*e)*_,t[8]=(o*e-i*r)*_,this}transpose(){let t,e=this.elements;return t=e[1],e[1]=e[3],e[3]=t,t=e[2],e[2]=e[6],e[6]=t,t=e[5],e[5]=e[7],e[7]=t,this}getNormalMatrix(t){return this.setFromMatrix4(t).invert().transpose()}transposeIntoArray(t){let e=this.elements;return t[0]=e[0],t[1]=e[3],t[2]=e[6],t[3]=e[1],t[4]=e[4],t[5]=e[7],t[6]=e[2],t[7]=e[5],t[8]=e[8],this}setUvTransform(t,e,i,s,r,o,a){let c=Math.cos(r),l=Math.sin(r);return this.set(i*c,i*l,-i*(c*o+l*a)+o+t,-s*l,s*c,-s*(-l*o+c*a)+a+e,0,0,1),this}scale(t,e){return ao("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(au.makeScale(t,e)),this}rotate(t){return ao("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(au.makeRotation(-t)),this}translate(t,e){return ao("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(au.makeTranslation(t,e)),this}makeTranslation(t,e){return t.isVector2?this.set(1,0,t.x,0,1,t.y,0,0,1):this.set(1,0,t,0,1,e,0,0,1),this}makeRotation(t){let e=Math.cos(t),i=Math.sin(t);return this.set(e,-i,0,i,e,0,0,0,1),this}makeScale(t,e){return this.set(t,0,0,0,e,0,0,0,1),this}equals(t){let e=this.elements,i=t.elements;for(let s=0;s<9;s++)if(e[s]!==i[s])return!1;return!0}fromArray(t,e=0){for(let i=0;i<9;i++)this.elements[i]=t[i+e];return this}toArray(t=[],e=0){let i=this.elements;return t[e]=i[0],t[e+1]=i[1],t[e+2]=i[2],t[e+3]=i[3],t[e+4]=i[4],t[e+5]=i[5],t[e+6]=i[6],t[e+7]=i[7],t[e+8]=i[8],t}clone(){return new this.constructor().fromArray(this.elements)}},au=new Ut,Em=new Ut().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),Am=new Ut().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function Av(){let n={enabled:!0,workingColorSpace:ho,spaces:{},convert:function(s,r,o){return this.enabled===!1||r===o||!r||!o||(this.spaces[r].transfer===te&&(s.r=_i(s.r),s.g=_i(s.g),s.b=_i(s.b)),this.spaces[r].primaries!==this.spaces[o].primaries&&(s.applyMatrix3(this.spaces[r].toXYZ),s.applyMatrix3(this.spaces[o].fromXYZ)),this.spaces[o].transfer===te&&(s.r=pr(s.r),s.g=pr(s.g),s.b=pr(s.b))),s},workingToColorSpace:function(s,r){return this.convert(s,this.workingColorSpace,r)},colorSpaceToWorking:function(s,r){return this.convert(s,r,this.workingColorSpace)},getPrimaries:function(s){return this.spaces[s].primaries},getTransfer:function(s){return s===Ai?uo:this.spaces[s].transfer},getToneMappingMode:function(s){return this.spaces[s].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(s,r=this.workingColorSpace){return s.fromArray(this.spaces[r].luminanceCoefficients)},define:function(s){Object.assign(this.spaces,s)},_getMatrix:function(s,r,o){return s.copy(this.spaces[o].fromXYZ).multiply(this.spaces[r].toXYZ)},_getDrawingBufferColorSpace:function(s){return this.spaces[s].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(s=this.workingColorSpace){return this.spaces[s].workingColorSpaceConfig.unpackColorSpace}},t=[.64,.33,.3,.6,.15,.06],e=[.2126,.7152,.0722],i=[.3127,.329];return n.define({[ho]:{primaries:t,whitePoint:i,transfer:uo,toXYZ:Em,fromXYZ:Am,luminanceCoefficients:e,workingColorSpaceConfig:{unpackColorSpace:Je},outputColorSpaceConfig:{drawingBufferColorSpace:Je}},[Je]:{primaries:t,whitePoint:i,transfer:te,toXYZ:Em,fromXYZ:Am,luminanceCoefficients:e,outputColorSpaceConfig:{drawingBufferColorSpace:Je}}}),n}var Yt=Av();function _i(n){return n<.04045?n*.0773993808:Math.pow(n*.9478672986+.0521327014,2.4)}function pr(n){return n<.0031308?n*12.92:1.055*Math.pow(n,.41666)-.055}var js,Tl=class{static getDataURL(t,e="image/png"){if(/^data:/i.test(t.src)||typeof HTMLCanvasElement>"u")return t.src;let i;if(t instanceof HTMLCanvasElement)i=t;else{js===void 0&&(js=fo("canvas")),js.width=t.width,js.height=t.height;let s=js.getContext("2d");t instanceof ImageData?s.putImageData(t,0,0):s.drawImage(t,0,0,t.width,t.height),i=js}return i.toDataURL(e)}static sRGBToLinear(t){if(typeof HTMLImageElement<"u"&&t instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&t instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&t instanceof ImageBitmap){let e=fo("canvas");e.width=t.width,e.height=t.height;let i=e.getContext("2d");i.drawImage(t,0,0,t.width,t.height);let s=i.getImageData(0,0,t.width,t.height),r=s.data;for(let o=0;o<r.length;o++)r[o]=_i(r[o]/255)*255;return i.putImageData(s,0,0),e}else if(t.data){let e=t.data.slice(0);for(let i=0;i<e.length;i++)e instanceof Uint8Array||e instanceof Uint8ClampedArray?e[i]=Math.floor(_i(e[i]/255)*255):e[i]=_i(e[i]);return{data:e,width:t.width,height:t.height}}else return It("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),t}},Tv=0,yr=class{constructor(t=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:Tv++}),this.uuid=Yi(),this.data=t,this.dataReady=!0,this.version=0}getSize(t){let e=this.data;return typeof HTMLVideoElement<"u"&&e instanceof HTMLVideoElement?t.set(e.videoWidth,e.videoHeight,0):typeof VideoFrame<"u"&&e instanceof VideoFrame?t.set(e.displayWidth,e.displayHeight,0):e!==null?t.set(e.width||0,e.height||0,e.depth||0):t.set(0,0,0),t}set needsUpdate(t){t===!0&&this.version++}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.images[this.uuid]!==void 0)return t.images[this.uuid];let i={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let o=0,a=s.length;o<a;o++)s[o].isDataTexture?r.push(lu(s[o].image)):r.push(lu(s[o]))}else r=lu(s);i.url=r}return e||(t.images[this.uuid]=i),i}};function lu(n){return typeof HTMLImageElement<"u"&&n instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&n instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&n instanceof ImageBitmap?Tl.getDataURL(n):n.data?{data:Array.from(n.data),width:n.width,height:n.height,type:n.data.constructor.name}:(It("Texture: Unable to serialize Texture."),{})}var Cv=0,cu=new N,tn=class n extends Nn{constructor(t=n.DEFAULT_IMAGE,e=n.DEFAULT_MAPPING,i=qn,s=qn,r=Qe,o=wi,a=zn,c=an,l=n.DEFAULT_ANISOTROPY,h=Ai){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:Cv++}),this.uuid=Yi(),this.name="",this.source=new yr(t),this.mipmaps=[],this.mapping=e,this.channel=0,this.wrapS=i,this.wrapT=s,this.magFilter=r,this.minFilter=o,this.anisotropy=l,this.format=a,this.internalFormat=null,this.type=c,this.offset=new Ct(0,0),this.repeat=new Ct(1,1),this.center=new Ct(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new Ut,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=h,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(t&&t.depth&&t.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(cu).x}get height(){return this.source.getSize(cu).y}get depth(){return this.source.getSize(cu).z}get image(){return this.source.data}set image(t){this.source.data=t}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(t){return this.name=t.name,this.source=t.source,this.mipmaps=t.mipmaps.slice(0),this.mapping=t.mapping,this.channel=t.channel,this.wrapS=t.wrapS,this.wrapT=t.wrapT,this.magFilter=t.magFilter,this.minFilter=t.minFilter,this.anisotropy=t.anisotropy,this.format=t.format,this.internalFormat=t.internalFormat,this.type=t.type,this.normalized=t.normalized,this.offset.copy(t.offset),this.repeat.copy(t.repeat),this.center.copy(t.center),this.rotation=t.rotation,this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrix.copy(t.matrix),this.generateMipmaps=t.generateMipmaps,this.mipmapsAutoUpdate=t.mipmapsAutoUpdate,this.premultiplyAlpha=t.premultiplyAlpha,this.flipY=t.flipY,this.unpackAlignment=t.unpackAlignment,this.colorSpace=t.colorSpace,this.renderTarget=t.renderTarget,this.isRenderTargetTexture=t.isRenderTargetTexture,this.isPMREMTexture=t.isPMREMTexture,this.isArrayTexture=t.isArrayTexture,this.userData=JSON.parse(JSON.stringify(t.userData)),this.needsUpdate=!0,this}setValues(t){for(let e in t){let i=t[e];if(i===void 0){It(`Texture.setValues(): parameter '${e}' has value of undefined.`);continue}let s=this[e];if(s===void 0){It(`Texture.setValues(): property '${e}' does not exist.`);continue}s&&i&&s.isVector2&&i.isVector2||s&&i&&s.isVector3&&i.isVector3||s&&i&&s.isMatrix3&&i.isMatrix3?s.copy(i):this[e]=i}}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.textures[this.uuid]!==void 0)return t.textures[this.uuid];let i={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(t).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(i.userData=this.userData),e||(t.textures[this.uuid]=i),i}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(t){if(this.mapping!==Ju)return t;if(t.applyMatrix3(this.matrix),t.x<0||t.x>1)switch(this.wrapS){case wl:t.x=t.x-Math.floor(t.x);break;case qn:t.x=t.x<0?0:1;break;case El:Math.abs(Math.floor(t.x)%2)===1?t.x=Math.ceil(t.x)-t.x:t.x=t.x-Math.floor(t.x);break}if(t.y<0||t.y>1)switch(this.wrapT){case wl:t.y=t.y-Math.floor(t.y);break;case qn:t.y=t.y<0?0:1;break;case El:Math.abs(Math.floor(t.y)%2)===1?t.y=Math.ceil(t.y)-t.y:t.y=t.y-Math.floor(t.y);break}return this.flipY&&(t.y=1-t.y),t}set needsUpdate(t){t===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(t){t===!0&&this.pmremVersion++}};tn.DEFAULT_IMAGE=null;tn.DEFAULT_MAPPING=Ju;tn.DEFAULT_ANISOTROPY=1;var ee=class{static{this.prototype.isVector4=!0}constructor(t=0,e=0,i=0,s=1){this.x=t,this.y=e,this.z=i,this.w=s}get width(){return this.z}set width(t){this.z=t}get height(){return this.w}set height(t){this.w=t}set(t,e,i,s){return this.x=t,this.y=e,this.z=i,this.w=s,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this.w=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setW(t){return this.w=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;case 3:this.w=e;break;default:throw new Error("THREE.Vector4: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this.w=t.w!==void 0?t.w:1,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this.w+=t.w,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this.w+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this.w=t.w+e.w,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this.w+=t.w*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this.w-=t.w,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this.w-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this.w=t.w-e.w,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this.w*=t.w,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this.w*=t,this}applyMatrix4(t){let e=this.x,i=this.y,s=this.z,r=this.w,o=t.elements;return this.x=o[0]*e+o[4]*i+o[8]*s+o[12]*r,this.y=o[1]*e+o[5]*i+o[9]*s+o[13]*r,this.z=o[2]*e+o[6]*i+o[10]*s+o[14]*r,this.w=o[3]*e+o[7]*i+o[11]*s+o[15]*r,this}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this.w/=t.w,this}divideScalar(t){return this.multiplyScalar(1/t)}setAxisAngleFromQuaternion(t){this.w=2*Math.acos(t.w);let e=Math.sqrt(1-t.w*t.w);return e<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=t.x/e,this.y=t.y/e,this.z=t.z/e),this}setAxisAngleFromRotationMatrix(t){let e,i,s,r,c=t.elements,l=c[0],h=c[4],u=c[8],f=c[1],d=c[5],g=c[9],_=c[2],m=c[6],p=c[10];if(Math.abs(h-f)<.01&&Math.abs(u-_)<.01&&Math.abs(g-m)<.01){if(Math.abs(h+f)<.1&&Math.abs(u+_)<.1&&Math.abs(g+m)<.1&&Math.abs(l+d+p-3)<.1)return this.set(1,0,0,0),this;e=Math.PI;let b=(l+1)/2,v=(d+1)/2,A=(p+1)/2,E=(h+f)/4,x=(u+_)/4,w=(g+m)/4;return b>v&&b>A?b<.01?(i=0,s=.707106781,r=.707106781):(i=Math.sqrt(b),s=E/i,r=x/i):v>A?v<.01?(i=.707106781,s=0,r=.707106781):(s=Math.sqrt(v),i=E/s,r=w/s):A<.01?(i=.707106781,s=.707106781,r=0):(r=Math.sqrt(A),i=x/r,s=w/r),this.set(i,s,r,e),this}let y=Math.sqrt((m-g)*(m-g)+(u-_)*(u-_)+(f-h)*(f-h));return Math.abs(y)<.001&&(y=1),this.x=(m-g)/y,this.y=(u-_)/y,this.z=(f-h)/y,this.w=Math.acos((l+d+p-1)/2),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this.w=e[15],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this.w=Math.min(this.w,t.w),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this.w=Math.max(this.w,t.w),this}clamp(t,e){return this.x=Bt(this.x,t.x,e.x),this.y=Bt(this.y,t.y,e.y),this.z=Bt(this.z,t.z,e.z),this.w=Bt(this.w,t.w,e.w),this}clampScalar(t,e){return this.x=Bt(this.x,t,e),this.y=Bt(this.y,t,e),this.z=Bt(this.z,t,e),this.w=Bt(this.w,t,e),this}clampLength(t,e){let i=this.length();return this.divideScalar(i||1).multiplyScalar(Bt(i,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z+this.w*t.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this.w+=(t.w-this.w)*e,this}lerpVectors(t,e,i){return this.x=t.x+(e.x-t.x)*i,this.y=t.y+(e.y-t.y)*i,this.z=t.z+(e.z-t.z)*i,this.w=t.w+(e.w-t.w)*i,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z&&t.w===this.w}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this.w=t[e+3],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t[e+3]=this.w,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this.w=t.getW(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}},Cl=class extends Nn{constructor(t=1,e=1,i={}){super(),i=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:Qe,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},i),this.isRenderTarget=!0,this.width=t,this.height=e,this.depth=i.depth,this.scissor=new ee(0,0,t,e),this.scissorTest=!1,this.viewport=new ee(0,0,t,e),this.textures=[];let s=i.count;for(let r=0;r<s;r++)this.textures[r]=new tn({width:t,height:e,depth:i.depth}),this.textures[r].isRenderTargetTexture=!0,this.textures[r].renderTarget=this;this._setTextureOptions(i),this.depthBuffer=i.depthBuffer,this.stencilBuffer=i.stencilBuffer,this.resolveColorBuffer=i.resolveColorBuffer,this.resolveDepthBuffer=i.resolveDepthBuffer,this.resolveStencilBuffer=i.resolveStencilBuffer,this.storeMultisampledColorBuffer=i.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=i.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=i.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=i.depthTexture,this.samples=i.samples,this.multiview=i.multiview,this.useArrayDepthTexture=i.useArrayDepthTexture}_setTextureOptions(t={}){let e={minFilter:Qe,generateMipmaps:!1,flipY:!1,internalFormat:null};t.mapping!==void 0&&(e.mapping=t.mapping),t.wrapS!==void 0&&(e.wrapS=t.wrapS),t.wrapT!==void 0&&(e.wrapT=t.wrapT),t.wrapR!==void 0&&(e.wrapR=t.wrapR),t.magFilter!==void 0&&(e.magFilter=t.magFilter),t.minFilter!==void 0&&(e.minFilter=t.minFilter),t.format!==void 0&&(e.format=t.format),t.type!==void 0&&(e.type=t.type),t.anisotropy!==void 0&&(e.anisotropy=t.anisotropy),t.colorSpace!==void 0&&(e.colorSpace=t.colorSpace),t.flipY!==void 0&&(e.flipY=t.flipY),t.generateMipmaps!==void 0&&(e.generateMipmaps=t.generateMipmaps),t.mipmapsAutoUpdate!==void 0&&(e.mipmapsAutoUpdate=t.mipmapsAutoUpdate),t.internalFormat!==void 0&&(e.internalFormat=t.internalFormat);for(let i=0;i<this.textures.length;i++)this.textures[i].setValues(e)}get texture(){return this.textures[0]}set texture(t){this.textures[0]=t}set depthTexture(t){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),t!==null&&t.renderTarget===null&&(t.renderTarget=this),this._depthTexture=t}get depthTexture(){return this._depthTexture}setSize(t,e,i=1){if(this.width!==t||this.height!==e||this.depth!==i){this.width=t,this.height=e,this.depth=i;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=t,this.textures[s].image.height=e,this.textures[s].image.depth=i,this.textures[s].isData3DTexture!==!0&&(this.textures[s].isArrayTexture=this.textures[s].image.depth>1);this.dispose()}this.viewport.set(0,0,t,e),this.scissor.set(0,0,t,e)}clone(){return new this.constructor().copy(this)}copy(t){this.width=t.width,this.height=t.height,this.depth=t.depth,this.scissor.copy(t.scissor),this.scissorTest=t.scissorTest,this.viewport.copy(t.viewport),this.textures.length=0;for(let e=0,i=t.textures.length;e<i;e++){this.textures[e]=t.textures[e].clone(),this.textures[e].isRenderTargetTexture=!0,this.textures[e].renderTarget=this;let s=Object.assign({},t.textures[e].image);this.textures[e].source=new yr(s)}if(this.depthBuffer=t.depthBuffer,this.stencilBuffer=t.stencilBuffer,this.resolveColorBuffer=t.resolveColorBuffer,this.resolveDepthBuffer=t.resolveDepthBuffer,this.resolveStencilBuffer=t.resolveStencilBuffer,this.storeMultisampledColorBuffer=t.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=t.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=t.storeMultisampledStencilBuffer,t.depthTexture!==null)if(t.depthTexture.renderTarget===t){let e=t.depthTexture.clone();e.renderTarget=null,this.depthTexture=e}else this.depthTexture=t.depthTexture;else this.depthTexture=null;return this.samples=t.samples,this.multiview=t.multiview,this.useArrayDepthTexture=t.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},fn=class extends Cl{constructor(t=1,e=1,i={}){super(t,e,i),this.isWebGLRenderTarget=!0}},mo=class extends tn{constructor(t=null,e=1,i=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:t,width:e,height:i,depth:s},this.magFilter=Ie,this.minFilter=Ie,this.wrapR=qn,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}addLayerUpdate(t){this.layerUpdates.add(t)}clearLayerUpdates(){this.layerUpdates.clear()}};var Rl=class extends tn{constructor(t=null,e=1,i=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:t,width:e,height:i,depth:s},this.magFilter=Ie,this.minFilter=Ie,this.wrapR=qn,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}};var se=class n{static{this.prototype.isMatrix4=!0}constructor(t,e,i,s,r,o,a,c,l,h,u,f,d,g,_,m){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],t!==void 0&&this.set(t,e,i,s,r,o,a,c,l,h,u,f,d,g,_,m)}set(t,e,i,s,r,o,a,c,l,h,u,f,d,g,_,m){let p=this.elements;return p[0]=t,p[4]=e,p[8]=i,p[12]=s,p[1]=r,p[5]=o,p[9]=a,p[13]=c,p[2]=l,p[6]=h,p[10]=u,p[14]=f,p[3]=d,p[7]=g,p[11]=_,p[15]=m,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new n().fromArray(this.elements)}copy(t){let e=this.elements,i=t.elements;return e[0]=i[0],e[1]=i[1],e[2]=i[2],e[3]=i[3],e[4]=i[4],e[5]=i[5],e[6]=i[6],e[7]=i[7],e[8]=i[8],e[9]=i[9],e[10]=i[10],e[11]=i[11],e[12]=i[12],e[13]=i[13],e[14]=i[14],e[15]=i[15],this}copyPosition(t){let e=this.elements,i=t.elements;return e[12]=i[12],e[13]=i[13],e[14]=i[14],this}setFromMatrix3(t){let e=t.elements;return this.set(e[0],e[3],e[6],0,e[1],e[4],e[7],0,e[2],e[5],e[8],0,0,0,0,1),this}extractBasis(t,e,i){return this.determinantAffine()===0?(t.set(1,0,0),e.set(0,1,0),i.set(0,0,1),this):(t.setFromMatrixColumn(this,0),e.setFromMatrixColumn(this,1),i.setFromMatrixColumn(this,2),this)}makeBasis(t,e,i){return this.set(t.x,e.x,i.x,0,t.y,e.y,i.y,0,t.z,e.z,i.z,0,0,0,0,1),this}extractRotation(t){if(t.determinantAffine()===0)return this.identity();let e=this.elements,i=t.elements,s=1/Qs.setFromMatrixColumn(t,0).length(),r=1/Qs.setFromMatrixColumn(t,1).length(),o=1/Qs.setFromMatrixColumn(t,2).length();return e[0]=i[0]*s,e[1]=i[1]*s,e[2]=i[2]*s,e[3]=0,e[4]=i[4]*r,e[5]=i[5]*r,e[6]=i[6]*r,e[7]=0,e[8]=i[8]*o,e[9]=i[9]*o,e[10]=i[10]*o,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromEuler(t){let e=this.elements,i=t.x,s=t.y,r=t.z,o=Math.cos(i),a=Math.sin(i),c=Math.cos(s),l=Math.sin(s),h=Math.cos(r),u=Math.sin(r);if(t.order==="XYZ"){let f=o*h,d=o*u,g=a*h,_=a*u;e[0]=c*h,e[4]=-c*u,e[8]=l,e[1]=d+g*l,e[5]=f-_*l,e[9]=-a*c,e[2]=_-f*l,e[6]=g+d*l,e[10]=o*c}else if(t.order==="YXZ"){let f=c*h,d=c*u,g=l*h,_=l*u;e[0]=f+_*a,e[4]=g*a-d,e[8]=o*l,e[1]=o*u,e[5]=o*h,e[9]=-a,e[2]=d*a-g,e[6]=_+f*a,e[10]=o*c}else if(t.order==="ZXY"){let f=c*h,d=c*u,g=l*h,_=l*u;e[0]=f-_*a,e[4]=-o*u,e[8]=g+d*a,e[1]=d+g*a,e[5]=o*h,e[9]=_-f*a,e[2]=-o*l,e[6]=a,e[10]=o*c}else if(t.order==="ZYX"){let f=o*h,d=o*u,g=a*h,_=a*u;e[0]=c*h,e[4]=g*l-d,e[8]=f*l+_,e[1]=c*u,e[5]=_*l+f,e[9]=d*l-g,e[2]=-l,e[6]=a*c,e[10]=o*c}else if(t.order==="YZX"){let f=o*c,d=o*l,g=a*c,_=a*l;e[0]=c*h,e[4]=_-f*u,e[8]=g*u+d,e[1]=u,e[5]=o*h,e[9]=-a*h,e[2]=-l*h,e[6]=d*u+g,e[10]=f-_*u}else if(t.order==="XZY"){let f=o*c,d=o*l,g=a*c,_=a*l;e[0]=c*h,e[4]=-u,e[8]=l*h,e[1]=f*u+_,e[5]=o*h,e[9]=d*u-g,e[2]=g*u-d,e[6]=a*h,e[10]=_*u+f}return e[3]=0,e[7]=0,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromQuaternion(t){return this.compose(Rv,t,Pv)}lookAt(t,e,i){let s=this.elements;return hn.subVectors(t,e),hn.lengthSq()===0&&(hn.z=1),hn.normalize(),Li.crossVectors(i,hn),Li.lengthSq()===0&&(Math.abs(i.z)===1?hn.x+=1e-4:hn.z+=1e-4,hn.normalize(),Li.crossVectors(i,hn)),Li.normalize(),Ha.crossVectors(hn,Li),s[0]=Li.x,s[4]=Ha.x,s[8]=hn.x,s[1]=Li.y,s[5]=Ha.y,s[9]=hn.y,s[2]=Li.z,s[6]=Ha.z,s[10]=hn.z,this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let i=t.elements,s=e.elements,r=this.elements,o=i[0],a=i[4],c=i[8],l=i[12],h=i[1],u=i[5],f=i[9],d=i[13],g=i[2],_=i[6],m=i[10],p=i[14],y=i[3],b=i[7],v=i[11],A=i[15],E=s[0],x=s[4],w=s[8],D=s[12],R=s[1],L=s[5],I=s[9],z=s[13],C=s[2],H=s[6],q=s[10],V=s[14],j=s[3],X=s[7],Y=s[11],st=s[15];return r[0]=o*E+a*R+c*C+l*j,r[4]=o*x+a*L+c*H+l*X,r[8]=o*w+a*I+c*q+l*Y,r[12]=o*D+a*z+c*V+l*st,r[1]=h*E+u*R+f*C+d*j,r[5]=h*x+u*L+f*H+d*X,r[9]=h*w+u*I+f*q+d*Y,r[13]=h*D+u*z+f*V+d*st,r[2]=g*E+_*R+m*C+p*j,r[6]=g*x+_*L+m*H+p*X,r[10]=g*w+_*I+m*q+p*Y,r[14]=g*D+_*z+m*V+p*st,r[3]=y*E+b*R+v*C+A*j,r[7]=y*x+b*L+v*H+A*X,r[11]=y*w+b*I+v*q+A*Y,r[15]=y*D+b*z+v*V+A*st,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[4]*=t,e[8]*=t,e[12]*=t,e[1]*=t,e[5]*=t,e[9]*=t,e[13]*=t,e[2]*=t,e[6]*=t,e[10]*=t,e[14]*=t,e[3]*=t,e[7]*=t,e[11]*=t,e[15]*=t,this}determinant(){let t=this.elements,e=t[0],i=t[4],s=t[8],r=t[12],o=t[1],a=t[5],c=t[9],l=t[13],h=t[2],u=t[6],f=t[10],d=t[14],g=t[3],_=t[7],m=t[11],p=t[15],y=c*d-l*f,b=a*d-l*u,v=a*f-c*u,A=o*d-l*h,E=o*f-c*h,x=o*u-a*h;return e*(_*y-m*b+p*v)-i*(g*y-m*A+p*E)+s*(g*b-_*A+p*x)-r*(g*v-_*E+m*x)}determinantAffine(){let t=this.elements,e=t[0],i=t[4],s=t[8],r=t[1],o=t[5],a=t[9],c=t[2],l=t[6],h=t[10];return e*(o*h-a*l)-i*(r*h-a*c)+s*(r*l-o*c)}transpose(){let t=this.elements,e;return e=t[1],t[1]=t[4],t[4]=e,e=t[2],t[2]=t[8],t[8]=e,e=t[6],t[6]=t[9],t[9]=e,e=t[3],t[3]=t[12],t[12]=e,e=t[7],t[7]=t[13],t[13]=e,e=t[11],t[11]=t[14],t[14]=e,this}setPosition(t,e,i){let s=this.elements;return t.isVector3?(s[12]=t.x,s[13]=t.y,s[14]=t.z):(s[12]=t,s[13]=e,s[14]=i),this}invert(){let t=this.elements,e=t[0],i=t[1],s=t[2],r=t[3],o=t[4],a=t[5],c=t[6],l=t[7],h=t[8],u=t[9],f=t[10],d=t[11],g=t[12],_=t[13],m=t[14],p=t[15],y=e*a-i*o,b=e*c-s*o,v=e*l-r*o,A=i*c-s*a,E=i*l-r*a,x=s*l-r*c,w=h*_-u*g,D=h*m-f*g,R=h*p-d*g,L=u*m-f*_,I=u*p-d*_,z=f*p-d*m,C=y*z-b*I+v*L+A*R-E*D+x*w;if(C===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let H=1/C;return t[0]=(a*z-c*I+l*L)*H,t[1]=(s*I-i*z-r*L)*H,t[2]=(_*x-m*E+p*A)*H,t[3]=(f*E-u*x-d*A)*H,t[4]=(c*R-o*z-l*D)*H,t[5]=(e*z-s*R+r*D)*H,t[6]=(m*v-g*x-p*b)*H,t[7]=(h*x-f*v+d*b)*H,t[8]=(o*I-a*R+l*w)*H,t[9]=(i*R-e*I-r*w)*H,t[10]=(g*E-_*v+p*y)*H,t[11]=(u*v-h*E-d*y)*H,t[12]=(a*D-o*L-c*w)*H,t[13]=(e*L-i*D+s*w)*H,t[14]=(_*b-g*A-m*y)*H,t[15]=(h*A-u*b+f*y)*H,this}scale(t){let e=this.elements,i=t.x,s=t.y,r=t.z;return e[0]*=i,e[4]*=s,e[8]*=r,e[1]*=i,e[5]*=s,e[9]*=r,e[2]*=i,e[6]*=s,e[10]*=r,e[3]*=i,e[7]*=s,e[11]*=r,this}getMaxScaleOnAxis(){let t=this.elements,e=t[0]*t[0]+t[1]*t[1]+t[2]*t[2],i=t[4]*t[4]+t[5]*t[5]+t[6]*t[6],s=t[8]*t[8]+t[9]*t[9]+t[10]*t[10];return Math.sqrt(Math.max(e,i,s))}makeTranslation(t,e,i){return t.isVector3?this.set(1,0,0,t.x,0,1,0,t.y,0,0,1,t.z,0,0,0,1):this.set(1,0,0,t,0,1,0,e,0,0,1,i,0,0,0,1),this}makeRotationX(t){let e=Math.cos(t),i=Math.sin(t);return this.set(1,0,0,0,0,e,-i,0,0,i,e,0,0,0,0,1),this}makeRotationY(t){let e=Math.cos(t),i=Math.sin(t);return this.set(e,0,i,0,0,1,0,0,-i,0,e,0,0,0,0,1),this}makeRotationZ(t){let e=Math.cos(t),i=Math.sin(t);return this.set(e,-i,0,0,i,e,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(t,e){let i=Math.cos(e),s=Math.sin(e),r=1-i,o=t.x,a=t.y,c=t.z,l=r*o,h=r*a;return this.set(l*o+i,l*a-s*c,l*c+s*a,0,l*a+s*c,h*a+i,h*c-s*o,0,l*c-s*a,h*c+s*o,r*c*c+i,0,0,0,0,1),this}makeScale(t,e,i){return this.set(t,0,0,0,0,e,0,0,0,0,i,0,0,0,0,1),this}makeShear(t,e,i,s,r,o){return this.set(1,i,r,0,t,1,o,0,e,s,1,0,0,0,0,1),this}compose(t,e,i){let s=this.elements,r=e._x,o=e._y,a=e._z,c=e._w,l=r+r,h=o+o,u=a+a,f=r*l,d=r*h,g=r*u,_=o*h,m=o*u,p=a*u,y=c*l,b=c*h,v=c*u,A=i.x,E=i.y,x=i.z;return s[0]=(1-(_+p))*A,s[1]=(d+v)*A,s[2]=(g-b)*A,s[3]=0,s[4]=(d-v)*E,s[5]=(1-(f+p))*E,s[6]=(m+y)*E,s[7]=0,s[8]=(g+b)*x,s[9]=(m-y)*x,s[10]=(1-(f+_))*x,s[11]=0,s[12]=t.x,s[13]=t.y,s[14]=t.z,s[15]=1,this}decompose(t,e,i){let s=this.elements;t.x=s[12],t.y=s[13],t.z=s[14];let r=this.determinantAffine();if(r===0)return i.set(1,1,1),e.identity(),this;let o=Qs.set(s[0],s[1],s[2]).length(),a=Qs.set(s[4],s[5],s[6]).length(),c=Qs.set(s[8],s[9],s[10]).length();r<0&&(o=-o),Rn.copy(this);let l=1/o,h=1/a,u=1/c;return Rn.elements[0]*=l,Rn.elements[1]*=l,Rn.elements[2]*=l,Rn.elements[4]*=h,Rn.elements[5]*=h,Rn.elements[6]*=h,Rn.elements[8]*=u,Rn.elements[9]*=u,Rn.elements[10]*=u,e.setFromRotationMatrix(Rn),i.x=o,i.y=a,i.z=c,this}makePerspective(t,e,i,s,r,o,a=bn,c=!1){let l=this.elements,h=2*r/(e-t),u=2*r/(i-s),f=(e+t)/(e-t),d=(i+s)/(i-s),g,_;if(c)g=r/(o-r),_=o*r/(o-r);else if(a===bn)g=-(o+r)/(o-r),_=-2*o*r/(o-r);else if(a===gr)g=-o/(o-r),_=-o*r/(o-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return l[0]=h,l[4]=0,l[8]=f,l[12]=0,l[1]=0,l[5]=u,l[9]=d,l[13]=0,l[2]=0,l[6]=0,l[10]=g,l[14]=_,l[3]=0,l[7]=0,l[11]=-1,l[15]=0,this}makeOrthographic(t,e,i,s,r,o,a=bn,c=!1){let l=this.elements,h=2/(e-t),u=2/(i-s),f=-(e+t)/(e-t),d=-(i+s)/(i-s),g,_;if(c)g=1/(o-r),_=o/(o-r);else if(a===bn)g=-2/(o-r),_=-(o+r)/(o-r);else if(a===gr)g=-1/(o-r),_=-r/(o-r);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return l[0]=h,l[4]=0,l[8]=0,l[12]=f,l[1]=0,l[5]=u,l[9]=0,l[13]=d,l[2]=0,l[6]=0,l[10]=g,l[14]=_,l[3]=0,l[7]=0,l[11]=0,l[15]=1,this}equals(t){let e=this.elements,i=t.elements;for(let s=0;s<16;s++)if(e[s]!==i[s])return!1;return!0}fromArray(t,e=0){for(let i=0;i<16;i++)this.elements[i]=t[i+e];return this}toArray(t=[],e=0){let i=this.elements;return t[e]=i[0],t[e+1]=i[1],t[e+2]=i[2],t[e+3]=i[3],t[e+4]=i[4],t[e+5]=i[5],t[e+6]=i[6],t[e+7]=i[7],t[e+8]=i[8],t[e+9]=i[9],t[e+10]=i[10],t[e+11]=i[11],t[e+12]=i[12],t[e+13]=i[13],t[e+14]=i[14],t[e+15]=i[15],t}},Qs=new N,Rn=new se,Rv=new N(0,0,0),Pv=new N(1,1,1),Li=new N,Ha=new N,hn=new N,Tm=new se,Cm=new Ne,yi=class n{constructor(t=0,e=0,i=0,s=n.DEFAULT_ORDER){this.isEuler=!0,this._x=t,this._y=e,this._z=i,this._order=s}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get order(){return this._order}set order(t){this._order=t,this._onChangeCallback()}set(t,e,i,s=this._order){return this._x=t,this._y=e,this._z=i,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(t){return this._x=t._x,this._y=t._y,this._z=t._z,this._order=t._order,this._onChangeCallback(),this}setFromRotationMatrix(t,e=this._order,i=!0){let s=t.elements,r=s[0],o=s[4],a=s[8],c=s[1],l=s[5],h=s[9],u=s[2],f=s[6],d=s[10];switch(e){case"XYZ":this._y=Math.asin(Bt(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-h,d),this._z=Math.atan2(-o,r)):(this._x=Math.atan2(f,l),this._z=0);break;case"YXZ":this._x=Math.asin(-Bt(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(a,d),this._z=Math.atan2(c,l)):(this._y=Math.atan2(-u,r),this._z=0);break;case"ZXY":this._x=Math.asin(Bt(f,-1,1)),Math.abs(f)<.9999999?(this._y=Math.atan2(-u,d),this._z=Math.atan2(-o,l)):(this._y=0,this._z=Math.atan2(c,r));break;case"ZYX":this._y=Math.asin(-Bt(u,-1,1)),Math.abs(u)<.9999999?(this._x=Math.atan2(f,d),this._z=Math.atan2(c,r)):(this._x=0,this._z=Math.atan2(-o,l));break;case"YZX":this._z=Math.asin(Bt(c,-1,1)),Math.abs(c)<.9999999?(this._x=Math.atan2(-h,l),this._y=Math.atan2(-u,r)):(this._x=0,this._y=Math.atan2(a,d));break;case"XZY":this._z=Math.asin(-Bt(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(f,l),this._y=Math.atan2(a,r)):(this._x=Math.atan2(-h,d),this._y=0);break;default:It("Euler: .setFromRotationMatrix() encountered an unknown order: "+e)}return this._order=e,i===!0&&this._onChangeCallback(),this}setFromQuaternion(t,e,i){return Tm.makeRotationFromQuaternion(t),this.setFromRotationMatrix(Tm,e,i)}setFromVector3(t,e=this._order){return this.set(t.x,t.y,t.z,e)}reorder(t){return Cm.setFromEuler(this),this.setFromQuaternion(Cm,t)}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._order===this._order}fromArray(t){return this._x=t[0],this._y=t[1],this._z=t[2],t[3]!==void 0&&(this._order=t[3]),this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._order,t}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};yi.DEFAULT_ORDER="XYZ";var vr=class{constructor(){this.mask=1}set(t){this.mask=(1<<t|0)>>>0}enable(t){this.mask|=1<<t|0}enableAll(){this.mask=-1}toggle(t){this.mask^=1<<t|0}disable(t){this.mask&=~(1<<t|0)}disableAll(){this.mask=0}test(t){return(this.mask&t.mask)!==0}isEnabled(t){return(this.mask&(1<<t|0))!==0}},Iv=0,Rm=new N,tr=new Ne,ui=new se,Wa=new N,no=new N,Lv=new N,Nv=new Ne,Pm=new N(1,0,0),Im=new N(0,1,0),Lm=new N(0,0,1),Nm={type:"added"},Dv={type:"removed"},er={type:"childadded",child:null},hu={type:"childremoved",child:null},$e=class n extends Nn{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:Iv++}),this.uuid=Yi(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=n.DEFAULT_UP.clone();let t=new N,e=new yi,i=new Ne,s=new N(1,1,1);function r(){i.setFromEuler(e,!1)}function o(){e.setFromQuaternion(i,void 0,!1)}e._onChange(r),i._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:t},rotation:{configurable:!0,enumerable:!0,value:e},quaternion:{configurable:!0,enumerable:!0,value:i},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new se},normalMatrix:{value:new Ut}}),this.matrix=new se,this.matrixWorld=new se,this.matrixAutoUpdate=n.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=n.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new vr,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(t){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(t),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(t){return this.quaternion.premultiply(t),this}setRotationFromAxisAngle(t,e){this.quaternion.setFromAxisAngle(t,e)}setRotationFromEuler(t){this.quaternion.setFromEuler(t,!0)}setRotationFromMatrix(t){this.quaternion.setFromRotationMatrix(t)}setRotationFromQuaternion(t){this.quaternion.copy(t)}rotateOnAxis(t,e){return tr.setFromAxisAngle(t,e),this.quaternion.multiply(tr),this}rotateOnWorldAxis(t,e){return tr.setFromAxisAngle(t,e),this.quaternion.premultiply(tr),this}rotateX(t){return this.rotateOnAxis(Pm,t)}rotateY(t){return this.rotateOnAxis(Im,t)}rotateZ(t){return this.rotateOnAxis(Lm,t)}translateOnAxis(t,e){return Rm.copy(t).applyQuaternion(this.quaternion),this.position.add(Rm.multiplyScalar(e)),this}translateX(t){return this.translateOnAxis(Pm,t)}translateY(t){return this.translateOnAxis(Im,t)}translateZ(t){return this.translateOnAxis(Lm,t)}localToWorld(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(this.matrixWorld)}worldToLocal(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(ui.copy(this.matrixWorld).invert())}lookAt(t,e,i){t.isVector3?Wa.copy(t):Wa.set(t,e,i);let s=this.parent;this.updateWorldMatrix(!0,!1),no.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?ui.lookAt(no,Wa,this.up):ui.lookAt(Wa,no,this.up),this.quaternion.setFromRotationMatrix(ui),s&&(ui.extractRotation(s.matrixWorld),tr.setFromRotationMatrix(ui),this.quaternion.premultiply(tr.invert()))}add(t){if(arguments.length>1){for(let e=0;e<arguments.length;e++)this.add(arguments[e]);return this}return t===this?(Nt("Object3D.add: object can't be added as a child of itself.",t),this):(t&&t.isObject3D?(t.removeFromParent(),t.parent=this,this.children.push(t),t.dispatchEvent(Nm),er.child=t,this.dispatchEvent(er),er.child=null):Nt("Object3D.add: object not an instance of THREE.Object3D.",t),this)}remove(t){if(arguments.length>1){for(let i=0;i<arguments.length;i++)this.remove(arguments[i]);return this}let e=this.children.indexOf(t);return e!==-1&&(t.parent=null,this.children.splice(e,1),t.dispatchEvent(Dv),hu.child=t,this.dispatchEvent(hu),hu.child=null),this}removeFromParent(){let t=this.parent;return t!==null&&t.remove(this),this}clear(){return this.remove(...this.children)}attach(t){return this.updateWorldMatrix(!0,!1),ui.copy(this.matrixWorld).invert(),t.parent!==null&&(t.parent.updateWorldMatrix(!0,!1),ui.multiply(t.parent.matrixWorld)),t.applyMatrix4(ui),t.removeFromParent(),t.parent=this,this.children.push(t),t.updateWorldMatrix(!1,!0),t.dispatchEvent(Nm),er.child=t,this.dispatchEvent(er),er.child=null,this}getObjectById(t){return this.getObjectByProperty("id",t)}getObjectByName(t){return this.getObjectByProperty("name",t)}getObjectByProperty(t,e){if(this[t]===e)return this;for(let i=0,s=this.children.length;i<s;i++){let o=this.children[i].getObjectByProperty(t,e);if(o!==void 0)return o}}getObjectsByProperty(t,e,i=[]){this[t]===e&&i.push(this);let s=this.children;for(let r=0,o=s.length;r<o;r++)s[r].getObjectsByProperty(t,e,i);return i}getWorldPosition(t){return this.updateWorldMatrix(!0,!1),t.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(no,t,Lv),t}getWorldScale(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(no,Nv,t),t}getWorldDirection(t){this.updateWorldMatrix(!0,!1);let e=this.matrixWorld.elements;return t.set(e[8],e[9],e[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(t){t(this);let e=this.children;for(let i=0,s=e.length;i<s;i++)e[i].traverse(t)}traverseVisible(t){if(this.visible===!1)return;t(this);let e=this.children;for(let i=0,s=e.length;i<s;i++)e[i].traverseVisible(t)}traverseAncestors(t){let e=this.parent;e!==null&&(t(e),e.traverseAncestors(t))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let t=this.pivot;if(t!==null){let e=t.x,i=t.y,s=t.z,r=this.matrix.elements;r[12]+=e-r[0]*e-r[4]*i-r[8]*s,r[13]+=i-r[1]*e-r[5]*i-r[9]*s,r[14]+=s-r[2]*e-r[6]*i-r[10]*s}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(t){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||t)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,t=!0);let e=this.children;for(let i=0,s=e.length;i<s;i++)e[i].updateMatrixWorld(t)}updateWorldMatrix(t,e,i=!1){let s=this.parent;if(t===!0&&s!==null&&s.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||i)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,i=!0),e===!0){let r=this.children;for(let o=0,a=r.length;o<a;o++)r[o].updateWorldMatrix(!1,!0,i)}}toJSON(t){let e=t===void 0||typeof t=="string",i={};e&&(t={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},i.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let s={};s.uuid=this.uuid,s.type=this.type,s.name=this.name,s.castShadow=this.castShadow,s.receiveShadow=this.receiveShadow,s.visible=this.visible,s.frustumCulled=this.frustumCulled,s.renderOrder=this.renderOrder,s.static=this.static,s.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.pivot!==null&&(s.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(s.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(s.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.geometryInfo=this._geometryInfo.map(a=>({...a,boundingBox:a.boundingBox?a.boundingBox.toJSON():void 0,boundingSphere:a.boundingSphere?a.boundingSphere.toJSON():void 0})),s.instanceInfo=this._instanceInfo.map(a=>({...a})),s.availableInstanceIds=this._availableInstanceIds.slice(),s.availableGeometryIds=this._availableGeometryIds.slice(),s.nextIndexStart=this._nextIndexStart,s.nextVertexStart=this._nextVertexStart,s.geometryCount=this._geometryCount,s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.matricesTexture=this._matricesTexture.toJSON(t),s.indirectTexture=this._indirectTexture.toJSON(t),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(t)),this.boundingSphere!==null&&(s.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(s.boundingBox=this.boundingBox.toJSON()));function r(a,c){return a[c.uuid]===void 0&&(a[c.uuid]=c.toJSON(t)),c.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(t).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(t).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(t.geometries,this.geometry);let a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){let c=a.shapes;if(Array.isArray(c))for(let l=0,h=c.length;l<h;l++){let u=c[l];r(t.shapes,u)}else r(t.shapes,c)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(t.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let a=[];for(let c=0,l=this.material.length;c<l;c++)a.push(r(t.materials,this.material[c]));s.material=a}else s.material=r(t.materials,this.material);if(this.children.length>0){s.children=[];for(let a=0;a<this.children.length;a++)s.children.push(this.children[a].toJSON(t).object)}if(this.animations.length>0){s.animations=[];for(let a=0;a<this.animations.length;a++){let c=this.animations[a];s.animations.push(r(t.animations,c))}}if(e){let a=o(t.geometries),c=o(t.materials),l=o(t.textures),h=o(t.images),u=o(t.shapes),f=o(t.skeletons),d=o(t.animations),g=o(t.nodes);a.length>0&&(i.geometries=a),c.length>0&&(i.materials=c),l.length>0&&(i.textures=l),h.length>0&&(i.images=h),u.length>0&&(i.shapes=u),f.length>0&&(i.skeletons=f),d.length>0&&(i.animations=d),g.length>0&&(i.nodes=g)}return i.object=s,i;function o(a){let c=[];for(let l in a){let h=a[l];delete h.metadata,c.push(h)}return c}}clone(t){return new this.constructor().copy(this,t)}copy(t,e=!0){if(this.name=t.name,this.up.copy(t.up),this.position.copy(t.position),this.rotation.order=t.rotation.order,this.quaternion.copy(t.quaternion),this.scale.copy(t.scale),this.pivot=t.pivot!==null?t.pivot.clone():null,this.matrix.copy(t.matrix),this.matrixWorld.copy(t.matrixWorld),this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrixWorldAutoUpdate=t.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=t.matrixWorldNeedsUpdate,this.layers.mask=t.layers.mask,this.visible=t.visible,this.castShadow=t.castShadow,this.receiveShadow=t.receiveShadow,this.frustumCulled=t.frustumCulled,this.renderOrder=t.renderOrder,this.static=t.static,this.animations=t.animations.slice(),this.userData=JSON.parse(JSON.stringify(t.userData)),e===!0)for(let i=0;i<t.children.length;i++){let s=t.children[i];this.add(s.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};$e.DEFAULT_UP=new N(0,1,0);$e.DEFAULT_MATRIX_AUTO_UPDATE=!0;$e.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var Xe=class extends $e{constructor(){super(),this.isGroup=!0,this.type="Group"}},Uv={type:"move"},br=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new Xe,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new Xe,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new N,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new N),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new Xe,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new N,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new N,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(t){return this._targetRay!==null&&this._targetRay.dispatchEvent(t),this._grip!==null&&this._grip.dispatchEvent(t),this._hand!==null&&this._hand.dispatchEvent(t),this}connect(t){if(t&&t.hand){let e=this._hand;if(e)for(let i of t.hand.values())this._getHandJoint(e,i)}return this.dispatchEvent({type:"connected",data:t}),this}disconnect(t){return this.dispatchEvent({type:"disconnected",data:t}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(t,e,i){let s=null,r=null,o=null,a=this._targetRay,c=this._grip,l=this._hand;if(t&&e.session.visibilityState!=="visible-blurred"){if(l&&t.hand){o=!0;for(let _ of t.hand.values()){let m=e.getJointPose(_,i),p=this._getHandJoint(l,_);m!==null&&(p.matrix.fromArray(m.transform.matrix),p.matrix.decompose(p.position,p.quaternion,p.scale),p.matrixWorldNeedsUpdate=!0,p.jointRadius=m.radius),p.visible=m!==null}let h=l.joints["index-finger-tip"],u=l.joints["thumb-tip"],f=h.position.distanceTo(u.position),d=.02,g=.005;l.inputState.pinching&&f>d+g?(l.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:t.handedness,target:this})):!l.inputState.pinching&&f<=d-g&&(l.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:t.handedness,target:this}))}else c!==null&&t.gripSpace&&(r=e.getPose(t.gripSpace,i),r!==null&&(c.matrix.fromArray(r.transform.matrix),c.matrix.decompose(c.position,c.quaternion,c.scale),c.matrixWorldNeedsUpdate=!0,r.linearVelocity?(c.hasLinearVelocity=!0,c.linearVelocity.copy(r.linearVelocity)):c.hasLinearVelocity=!1,r.angularVelocity?(c.hasAngularVelocity=!0,c.angularVelocity.copy(r.angularVelocity)):c.hasAngularVelocity=!1,c.eventsEnabled&&c.dispatchEvent({type:"gripUpdated",data:t,target:this})));a!==null&&(s=e.getPose(t.targetRaySpace,i),s===null&&r!==null&&(s=r),s!==null&&(a.matrix.fromArray(s.transform.matrix),a.matrix.decompose(a.position,a.quaternion,a.scale),a.matrixWorldNeedsUpdate=!0,s.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(s.linearVelocity)):a.hasLinearVelocity=!1,s.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(s.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent(Uv)))}return a!==null&&(a.visible=s!==null),c!==null&&(c.visible=r!==null),l!==null&&(l.visible=o!==null),this}_getHandJoint(t,e){if(t.joints[e.jointName]===void 0){let i=new Xe;i.matrixAutoUpdate=!1,i.visible=!1,t.joints[e.jointName]=i,t.add(i)}return t.joints[e.jointName]}},Fg={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},Ni={h:0,s:0,l:0},Xa={h:0,s:0,l:0};function uu(n,t,e){return e<0&&(e+=1),e>1&&(e-=1),e<1/6?n+(t-n)*6*e:e<1/2?t:e<2/3?n+(t-n)*6*(2/3-e):n}var zt=class{constructor(t,e,i){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(t,e,i)}set(t,e,i){if(e===void 0&&i===void 0){let s=t;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(t,e,i);return this}setScalar(t){return this.r=t,this.g=t,this.b=t,this}setHex(t,e=Je){return t=Math.floor(t),this.r=(t>>16&255)/255,this.g=(t>>8&255)/255,this.b=(t&255)/255,Yt.colorSpaceToWorking(this,e),this}setRGB(t,e,i,s=Yt.workingColorSpace){return this.r=t,this.g=e,this.b=i,Yt.colorSpaceToWorking(this,s),this}setHSL(t,e,i,s=Yt.workingColorSpace){if(t=hf(t,1),e=Bt(e,0,1),i=Bt(i,0,1),e===0)this.r=this.g=this.b=i;else{let r=i<=.5?i*(1+e):i+e-i*e,o=2*i-r;this.r=uu(o,r,t+1/3),this.g=uu(o,r,t),this.b=uu(o,r,t-1/3)}return Yt.colorSpaceToWorking(this,s),this}setStyle(t,e=Je){function i(r){r!==void 0&&parseFloat(r)<1&&It("Color: Alpha component of "+t+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(t)){let r,o=s[1],a=s[2];switch(o){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,e);if(r=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setRGB(Math.min(100,parseFloat(r[1]))/100,Math.min(100,parseFloat(r[2]))/100,Math.min(100,parseFloat(r[3]))/100,e);break;case"hsl":case"hsla":if(r=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,e);break;default:It("Color: Unknown color model "+t)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(t)){let r=s[1],o=r.length;if(o===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,e);if(o===6)return this.setHex(parseInt(r,16),e);It("Color: Invalid hex color "+t)}else if(t&&t.length>0)return this.setColorName(t,e);return this}setColorName(t,e=Je){let i=Fg[t.toLowerCase()];return i!==void 0?this.setHex(i,e):It("Color: Unknown color "+t),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(t){return this.r=t.r,this.g=t.g,this.b=t.b,this}copySRGBToLinear(t){return this.r=_i(t.r),this.g=_i(t.g),this.b=_i(t.b),this}copyLinearToSRGB(t){return this.r=pr(t.r),this.g=pr(t.g),this.b=pr(t.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(t=Je){return Yt.workingToColorSpace(We.copy(this),t),Math.round(Bt(We.r*255,0,255))*65536+Math.round(Bt(We.g*255,0,255))*256+Math.round(Bt(We.b*255,0,255))}getHexString(t=Je){return("000000"+this.getHex(t).toString(16)).slice(-6)}getHSL(t,e=Yt.workingColorSpace){Yt.workingToColorSpace(We.copy(this),e);let i=We.r,s=We.g,r=We.b,o=Math.max(i,s,r),a=Math.min(i,s,r),c,l,h=(a+o)/2;if(a===o)c=0,l=0;else{let u=o-a;switch(l=h<=.5?u/(o+a):u/(2-o-a),o){case i:c=(s-r)/u+(s<r?6:0);break;case s:c=(r-i)/u+2;break;case r:c=(i-s)/u+4;break}c/=6}return t.h=c,t.s=l,t.l=h,t}getRGB(t,e=Yt.workingColorSpace){return Yt.workingToColorSpace(We.copy(this),e),t.r=We.r,t.g=We.g,t.b=We.b,t}getStyle(t=Je){Yt.workingToColorSpace(We.copy(this),t);let e=We.r,i=We.g,s=We.b;return t!==Je?`color(${t} ${e.toFixed(3)} ${i.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(e*255)},${Math.round(i*255)},${Math.round(s*255)})`}offsetHSL(t,e,i){return this.getHSL(Ni),this.setHSL(Ni.h+t,Ni.s+e,Ni.l+i)}add(t){return this.r+=t.r,this.g+=t.g,this.b+=t.b,this}addColors(t,e){return this.r=t.r+e.r,this.g=t.g+e.g,this.b=t.b+e.b,this}addScalar(t){return this.r+=t,this.g+=t,this.b+=t,this}sub(t){return this.r=Math.max(0,this.r-t.r),this.g=Math.max(0,this.g-t.g),this.b=Math.max(0,this.b-t.b),this}multiply(t){return this.r*=t.r,this.g*=t.g,this.b*=t.b,this}multiplyScalar(t){return this.r*=t,this.g*=t,this.b*=t,this}lerp(t,e){return this.r+=(t.r-this.r)*e,this.g+=(t.g-this.g)*e,this.b+=(t.b-this.b)*e,this}lerpColors(t,e,i){return this.r=t.r+(e.r-t.r)*i,this.g=t.g+(e.g-t.g)*i,this.b=t.b+(e.b-t.b)*i,this}lerpHSL(t,e){this.getHSL(Ni),t.getHSL(Xa);let i=lo(Ni.h,Xa.h,e),s=lo(Ni.s,Xa.s,e),r=lo(Ni.l,Xa.l,e);return this.setHSL(i,s,r),this}setFromVector3(t){return this.r=t.x,this.g=t.y,this.b=t.z,this}applyMatrix3(t){let e=this.r,i=this.g,s=this.b,r=t.elements;return this.r=r[0]*e+r[3]*i+r[6]*s,this.g=r[1]*e+r[4]*i+r[7]*s,this.b=r[2]*e+r[5]*i+r[8]*s,this}equals(t){return t.r===this.r&&t.g===this.g&&t.b===this.b}fromArray(t,e=0){return this.r=t[e],this.g=t[e+1],this.b=t[e+2],this}toArray(t=[],e=0){return t[e]=this.r,t[e+1]=this.g,t[e+2]=this.b,t}fromBufferAttribute(t,e){return this.r=t.getX(e),this.g=t.getY(e),this.b=t.getZ(e),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},We=new zt;zt.NAMES=Fg;var go=class extends $e{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new yi,this.environmentIntensity=1,this.environmentRotation=new yi,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(t,e){return super.copy(t,e),this.background=t.background!==null?t.background.clone():null,this.environment=t.environment!==null?t.environment.clone():null,this.fog=t.fog!==null?t.fog.clone():null,this.backgroundBlurriness=t.backgroundBlurriness,this.backgroundIntensity=t.backgroundIntensity,this.backgroundRotation.copy(t.backgroundRotation),this.environmentIntensity=t.environmentIntensity,this.environmentRotation.copy(t.environmentRotation),this.overrideMaterial=t.overrideMaterial!==null?t.overrideMaterial.clone():null,this.matrixAutoUpdate=t.matrixAutoUpdate,this}toJSON(t){let e=super.toJSON(t);return this.fog!==null&&(e.object.fog=this.fog.toJSON()),e.object.backgroundBlurriness=this.backgroundBlurriness,e.object.backgroundIntensity=this.backgroundIntensity,e.object.backgroundRotation=this.backgroundRotation.toArray(),e.object.environmentIntensity=this.environmentIntensity,e.object.environmentRotation=this.environmentRotation.toArray(),e}},Pn=new N,fi=new N,fu=new N,di=new N,nr=new N,ir=new N,Dm=new N,du=new N,pu=new N,mu=new N,gu=new ee,_u=new ee,xu=new ee,gi=class n{constructor(t=new N,e=new N,i=new N){this.a=t,this.b=e,this.c=i}static getNormal(t,e,i,s){s.subVectors(i,e),Pn.subVectors(t,e),s.cross(Pn);let r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(t,e,i,s,r){Pn.subVectors(s,e),fi.subVectors(i,e),fu.subVectors(t,e);let o=Pn.dot(Pn),a=Pn.dot(fi),c=Pn.dot(fu),l=fi.dot(fi),h=fi.dot(fu),u=o*l-a*a;if(u===0)return r.set(0,0,0),null;let f=1/u,d=(l*c-a*h)*f,g=(o*h-a*c)*f;return r.set(1-d-g,g,d)}static containsPoint(t,e,i,s){return this.getBarycoord(t,e,i,s,di)===null?!1:di.x>=0&&di.y>=0&&di.x+di.y<=1}static getInterpolation(t,e,i,s,r,o,a,c){return this.getBarycoord(t,e,i,s,di)===null?(c.x=0,c.y=0,"z"in c&&(c.z=0),"w"in c&&(c.w=0),null):(c.setScalar(0),c.addScaledVector(r,di.x),c.addScaledVector(o,di.y),c.addScaledVector(a,di.z),c)}static getInterpolatedAttribute(t,e,i,s,r,o){return gu.setScalar(0),_u.setScalar(0),xu.setScalar(0),gu.fromBufferAttribute(t,e),_u.fromBufferAttribute(t,i),xu.fromBufferAttribute(t,s),o.setScalar(0),o.addScaledVector(gu,r.x),o.addScaledVector(_u,r.y),o.addScaledVector(xu,r.z),o}static isFrontFacing(t,e,i,s){return Pn.subVectors(i,e),fi.subVectors(t,e),Pn.cross(fi).dot(s)<0}set(t,e,i){return this.a.copy(t),this.b.copy(e),this.c.copy(i),this}setFromPointsAndIndices(t,e,i,s){return this.a.copy(t[e]),this.b.copy(t[i]),this.c.copy(t[s]),this}setFromAttributeAndIndices(t,e,i,s){return this.a.fromBufferAttribute(t,e),this.b.fromBufferAttribute(t,i),this.c.fromBufferAttribute(t,s),this}clone(){return new this.constructor().copy(this)}copy(t){return this.a.copy(t.a),this.b.copy(t.b),this.c.copy(t.c),this}getArea(){return Pn.subVectors(this.c,this.b),fi.subVectors(this.a,this.b),Pn.cross(fi).length()*.5}getMidpoint(t){return t.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(t){return n.getNormal(this.a,this.b,this.c,t)}getPlane(t){return t.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(t,e){return n.getBarycoord(t,this.a,this.b,this.c,e)}getInterpolation(t,e,i,s,r){return n.getInterpolation(t,this.a,this.b,this.c,e,i,s,r)}containsPoint(t){return n.containsPoint(t,this.a,this.b,this.c)}isFrontFacing(t){return n.isFrontFacing(this.a,this.b,this.c,t)}intersectsBox(t){return t.intersectsTriangle(this)}closestPointToPoint(t,e){let i=this.a,s=this.b,r=this.c,o,a;nr.subVectors(s,i),ir.subVectors(r,i),du.subVectors(t,i);let c=nr.dot(du),l=ir.dot(du);if(c<=0&&l<=0)return e.copy(i);pu.subVectors(t,s);let h=nr.dot(pu),u=ir.dot(pu);if(h>=0&&u<=h)return e.copy(s);let f=c*u-h*l;if(f<=0&&c>=0&&h<=0&&c-h>0)return o=c/(c-h),e.copy(i).addScaledVector(nr,o);mu.subVectors(t,r);let d=nr.dot(mu),g=ir.dot(mu);if(g>=0&&d<=g)return e.copy(r);let _=d*l-c*g;if(_<=0&&l>=0&&g<=0)return a=l/(l-g),e.copy(i).addScaledVector(ir,a);let m=h*g-d*u;if(m<=0&&u-h>=0&&d-g>=0)return Dm.subVectors(r,s),a=(u-h)/(u-h+(d-g)),e.copy(s).addScaledVector(Dm,a);let p=1/(m+_+f);return o=_*p,a=f*p,e.copy(i).addScaledVector(nr,o).addScaledVector(ir,a)}equals(t){return t.a.equals(this.a)&&t.b.equals(this.b)&&t.c.equals(this.c)}},dn=class{constructor(t=new N(1/0,1/0,1/0),e=new N(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=t,this.max=e}set(t,e){return this.min.copy(t),this.max.copy(e),this}setFromArray(t){this.makeEmpty();for(let e=0,i=t.length;e<i;e+=3)this.expandByPoint(In.fromArray(t,e));return this}setFromBufferAttribute(t){this.makeEmpty();for(let e=0,i=t.count;e<i;e++)this.expandByPoint(In.fromBufferAttribute(t,e));return this}setFromPoints(t){this.makeEmpty();for(let e=0,i=t.length;e<i;e++)this.expandByPoint(t[e]);return this}setFromCenterAndSize(t,e){let i=In.copy(e).multiplyScalar(.5);return this.min.copy(t).sub(i),this.max.copy(t).add(i),this}setFromObject(t,e=!1){return this.makeEmpty(),this.expandByObject(t,e)}clone(){return new this.constructor().copy(this)}copy(t){return this.min.copy(t.min),this.max.copy(t.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(t){return this.isEmpty()?t.set(0,0,0):t.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(t){return this.isEmpty()?t.set(0,0,0):t.subVectors(this.max,this.min)}expandByPoint(t){return this.min.min(t),this.max.max(t),this}expandByVector(t){return this.min.sub(t),this.max.add(t),this}expandByScalar(t){return this.min.addScalar(-t),this.max.addScalar(t),this}expandByObject(t,e=!1){t.updateWorldMatrix(!1,!1);let i=t.geometry;if(i!==void 0){let r=i.getAttribute("position");if(e===!0&&r!==void 0&&t.isInstancedMesh!==!0&&t.isBatchedMesh!==!0)for(let o=0,a=r.count;o<a;o++)t.isMesh===!0?t.getVertexPosition(o,In):In.fromBufferAttribute(r,o),In.applyMatrix4(t.matrixWorld),this.expandByPoint(In);else t.boundingBox!==void 0?(t.boundingBox===null&&t.computeBoundingBox(),$a.copy(t.boundingBox)):(i.boundingBox===null&&i.computeBoundingBox(),$a.copy(i.boundingBox)),$a.applyMatrix4(t.matrixWorld),this.union($a)}let s=t.children;for(let r=0,o=s.length;r<o;r++)this.expandByObject(s[r],e);return this}containsPoint(t){return t.x>=this.min.x&&t.x<=this.max.x&&t.y>=this.min.y&&t.y<=this.max.y&&t.z>=this.min.z&&t.z<=this.max.z}containsBox(t){return this.min.x<=t.min.x&&t.max.x<=this.max.x&&this.min.y<=t.min.y&&t.max.y<=this.max.y&&this.min.z<=t.min.z&&t.max.z<=this.max.z}getParameter(t,e){return e.set((t.x-this.min.x)/(this.max.x-this.min.x),(t.y-this.min.y)/(this.max.y-this.min.y),(t.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(t){return t.max.x>=this.min.x&&t.min.x<=this.max.x&&t.max.y>=this.min.y&&t.min.y<=this.max.y&&t.max.z>=this.min.z&&t.min.z<=this.max.z}intersectsSphere(t){return this.clampPoint(t.center,In),In.distanceToSquared(t.center)<=t.radius*t.radius}intersectsPlane(t){let e,i;return t.normal.x>0?(e=t.normal.x*this.min.x,i=t.normal.x*this.max.x):(e=t.normal.x*this.max.x,i=t.normal.x*this.min.x),t.normal.y>0?(e+=t.normal.y*this.min.y,i+=t.normal.y*this.max.y):(e+=t.normal.y*this.max.y,i+=t.normal.y*this.min.y),t.normal.z>0?(e+=t.normal.z*this.min.z,i+=t.normal.z*this.max.z):(e+=t.normal.z*this.max.z,i+=t.normal.z*this.min.z),e<=-t.constant&&i>=-t.constant}intersectsTriangle(t){if(this.isEmpty())return!1;this.getCenter(io),qa.subVectors(this.max,io),sr.subVectors(t.a,io),rr.subVectors(t.b,io),or.subVectors(t.c,io),Di.subVectors(rr,sr),Ui.subVectors(or,rr),ds.subVectors(sr,or);let e=[0,-Di.z,Di.y,0,-Ui.z,Ui.y,0,-ds.z,ds.y,Di.z,0,-Di.x,Ui.z,0,-Ui.x,ds.z,0,-ds.x,-Di.y,Di.x,0,-Ui.y,Ui.x,0,-ds.y,ds.x,0];return!yu(e,sr,rr,or,qa)||(e=[1,0,0,0,1,0,0,0,1],!yu(e,sr,rr,or,qa))?!1:(Ya.crossVectors(Di,Ui),e=[Ya.x,Ya.y,Ya.z],yu(e,sr,rr,or,qa))}clampPoint(t,e){return e.copy(t).clamp(this.min,this.max)}distanceToPoint(t){return this.clampPoint(t,In).distanceTo(t)}getBoundingSphere(t){return this.isEmpty()?t.makeEmpty():(this.getCenter(t.center),t.radius=this.getSize(In).length()*.5),t}intersect(t){return this.min.max(t.min),this.max.min(t.max),this.isEmpty()&&this.makeEmpty(),this}union(t){return this.min.min(t.min),this.max.max(t.max),this}applyMatrix4(t){return this.isEmpty()?this:(pi[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(t),pi[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(t),pi[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(t),pi[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(t),pi[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(t),pi[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(t),pi[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(t),pi[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(t),this.setFromPoints(pi),this)}translate(t){return this.min.add(t),this.max.add(t),this}equals(t){return t.min.equals(this.min)&&t.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(t){return this.min.fromArray(t.min),this.max.fromArray(t.max),this}},pi=[new N,new N,new N,new N,new N,new N,new N,new N],In=new N,$a=new dn,sr=new N,rr=new N,or=new N,Di=new N,Ui=new N,ds=new N,io=new N,qa=new N,Ya=new N,ps=new N;function yu(n,t,e,i,s){for(let r=0,o=n.length-3;r<=o;r+=3){ps.fromArray(n,r);let a=s.x*Math.abs(ps.x)+s.y*Math.abs(ps.y)+s.z*Math.abs(ps.z),c=t.dot(ps),l=e.dot(ps),h=i.dot(ps);if(Math.max(-Math.max(c,l,h),Math.min(c,l,h))>a)return!1}return!0}var ye=new N,Za=new Ct,Ov=0,Ln=class extends Nn{constructor(t,e,i=!1){if(super(),Array.isArray(t))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:Ov++}),this.name="",this.array=t,this.itemSize=e,this.count=t!==void 0?t.length/e:0,this.normalized=i,this.usage=lf,this.updateRanges=[],this.gpuType=Bn,this.version=0,this._normalizationScale=t!==void 0?Bc(t):void 0}onUploadCallback(){}set needsUpdate(t){t===!0&&this.version++}setUsage(t){return this.usage=t,this}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}copy(t){return this.name=t.name,this.array=new t.array.constructor(t.array),this.itemSize=t.itemSize,this.count=t.count,this.normalized=t.normalized,this.usage=t.usage,this.gpuType=t.gpuType,this._normalizationScale=t._normalizationScale,this}copyAt(t,e,i){t*=this.itemSize,i*=e.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[t+s]=e.array[i+s];return this}copyArray(t){return this.array.set(t),this}applyMatrix3(t){if(this.itemSize===2)for(let e=0,i=this.count;e<i;e++)Za.fromBufferAttribute(this,e),Za.applyMatrix3(t),this.setXY(e,Za.x,Za.y);else if(this.itemSize===3)for(let e=0,i=this.count;e<i;e++)ye.fromBufferAttribute(this,e),ye.applyMatrix3(t),this.setXYZ(e,ye.x,ye.y,ye.z);return this}applyMatrix4(t){for(let e=0,i=this.count;e<i;e++)ye.fromBufferAttribute(this,e),ye.applyMatrix4(t),this.setXYZ(e,ye.x,ye.y,ye.z);return this}applyNormalMatrix(t){for(let e=0,i=this.count;e<i;e++)ye.fromBufferAttribute(this,e),ye.applyNormalMatrix(t),this.setXYZ(e,ye.x,ye.y,ye.z);return this}transformDirection(t){for(let e=0,i=this.count;e<i;e++)ye.fromBufferAttribute(this,e),ye.transformDirection(t),this.setXYZ(e,ye.x,ye.y,ye.z);return this}set(t,e=0){return this.array.set(t,e),this}getComponent(t,e){let i=this.array[t*this.itemSize+e];return this.normalized&&(i=this._denormalize(i)),i}setComponent(t,e,i){return this.normalized&&(i=this._normalize(i)),this.array[t*this.itemSize+e]=i,this}getX(t){let e=this.array[t*this.itemSize];return this.normalized&&(e=this._denormalize(e)),e}setX(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize]=e,this}getY(t){let e=this.array[t*this.itemSize+1];return this.normalized&&(e=this._denormalize(e)),e}setY(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+1]=e,this}getZ(t){let e=this.array[t*this.itemSize+2];return this.normalized&&(e=this._denormalize(e)),e}setZ(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+2]=e,this}getW(t){let e=this.array[t*this.itemSize+3];return this.normalized&&(e=this._denormalize(e)),e}setW(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+3]=e,this}setXY(t,e,i){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),i=this._normalize(i)),this.array[t+0]=e,this.array[t+1]=i,this}setXYZ(t,e,i,s){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),i=this._normalize(i),s=this._normalize(s)),this.array[t+0]=e,this.array[t+1]=i,this.array[t+2]=s,this}setXYZW(t,e,i,s,r){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),i=this._normalize(i),s=this._normalize(s),r=this._normalize(r)),this.array[t+0]=e,this.array[t+1]=i,this.array[t+2]=s,this.array[t+3]=r,this}onUpload(t){return this.onUploadCallback=t,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let t={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return t.name=this.name,t.usage=this.usage,t.gpuType=this.gpuType,t}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(t){let e=this._normalizationScale;return e!==void 0?Math.max(t/e,-1):ff(t,this.array)}_normalize(t){let e=this._normalizationScale;return e!==void 0?Math.round(t*e):df(t,this.array)}};var _o=class extends Ln{constructor(t,e,i){super(new Uint16Array(t),e,i)}};var xo=class extends Ln{constructor(t,e,i){super(new Uint32Array(t),e,i)}};var Ht=class extends Ln{constructor(t,e,i){super(new Float32Array(t),e,i)}},Fv=new dn,so=new N,vu=new N,Dn=class{constructor(t=new N,e=-1){this.isSphere=!0,this.center=t,this.radius=e}set(t,e){return this.center.copy(t),this.radius=e,this}setFromPoints(t,e){let i=this.center;e!==void 0?i.copy(e):Fv.setFromPoints(t).getCenter(i);let s=0;for(let r=0,o=t.length;r<o;r++)s=Math.max(s,i.distanceToSquared(t[r]));return this.radius=Math.sqrt(s),this}copy(t){return this.center.copy(t.center),this.radius=t.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(t){return t.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(t){return t.distanceTo(this.center)-this.radius}intersectsSphere(t){let e=this.radius+t.radius;return t.center.distanceToSquared(this.center)<=e*e}intersectsBox(t){return t.intersectsSphere(this)}intersectsPlane(t){return Math.abs(t.distanceToPoint(this.center))<=this.radius}clampPoint(t,e){let i=this.center.distanceToSquared(t);return e.copy(t),i>this.radius*this.radius&&(e.sub(this.center).normalize(),e.multiplyScalar(this.radius).add(this.center)),e}getBoundingBox(t){return this.isEmpty()?(t.makeEmpty(),t):(t.set(this.center,this.center),t.expandByScalar(this.radius),t)}applyMatrix4(t){return this.center.applyMatrix4(t),this.radius=this.radius*t.getMaxScaleOnAxis(),this}translate(t){return this.center.add(t),this}expandByPoint(t){if(this.isEmpty())return this.center.copy(t),this.radius=0,this;so.subVectors(t,this.center);let e=so.lengthSq();if(e>this.radius*this.radius){let i=Math.sqrt(e),s=(i-this.radius)*.5;this.center.addScaledVector(so,s/i),this.radius+=s}return this}union(t){return t.isEmpty()?this:this.isEmpty()?(this.copy(t),this):(this.center.equals(t.center)===!0?this.radius=Math.max(this.radius,t.radius):(vu.subVectors(t.center,this.center).setLength(t.radius),this.expandByPoint(so.copy(t.center).add(vu)),this.expandByPoint(so.copy(t.center).sub(vu))),this)}equals(t){return t.center.equals(this.center)&&t.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(t){return this.radius=t.radius,this.center.fromArray(t.center),this}},Bv=0,vn=new se,bu=new $e,ar=new N,un=new dn,ro=new dn,Pe=new N,he=class n extends Nn{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:Bv++}),this.uuid=Yi(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(t){return Array.isArray(t)?this.index=new(cv(t)?xo:_o)(t,1):this.index=t,this}setIndirect(t,e=0){return this.indirect=t,this.indirectOffset=e,this}getIndirect(){return this.indirect}getAttribute(t){return this.attributes[t]}setAttribute(t,e){return this.attributes[t]=e,this}deleteAttribute(t){return delete this.attributes[t],this}hasAttribute(t){return this.attributes[t]!==void 0}addGroup(t,e,i=0){this.groups.push({start:t,count:e,materialIndex:i})}clearGroups(){this.groups=[]}setDrawRange(t,e){this.drawRange.start=t,this.drawRange.count=e}applyMatrix4(t){let e=this.attributes.position;e!==void 0&&(e.applyMatrix4(t),e.needsUpdate=!0);let i=this.attributes.normal;if(i!==void 0){let r=new Ut().getNormalMatrix(t);i.applyNormalMatrix(r),i.needsUpdate=!0}let s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(t),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(t){return vn.makeRotationFromQuaternion(t),this.applyMatrix4(vn),this}rotateX(t){return vn.makeRotationX(t),this.applyMatrix4(vn),this}rotateY(t){return vn.makeRotationY(t),this.applyMatrix4(vn),this}rotateZ(t){return vn.makeRotationZ(t),this.applyMatrix4(vn),this}translate(t,e,i){return vn.makeTranslation(t,e,i),this.applyMatrix4(vn),this}scale(t,e,i){return vn.makeScale(t,e,i),this.applyMatrix4(vn),this}lookAt(t){return bu.lookAt(t),bu.updateMatrix(),this.applyMatrix4(bu.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(ar).negate(),this.translate(ar.x,ar.y,ar.z),this}setFromPoints(t){let e=this.getAttribute("position");if(e===void 0){let i=[];for(let s=0,r=t.length;s<r;s++){let o=t[s];i.push(o.x,o.y,o.z||0)}this.setAttribute("position",new Ht(i,3))}else{let i=Math.min(t.length,e.count);for(let s=0;s<i;s++){let r=t[s];e.setXYZ(s,r.x,r.y,r.z||0)}t.length>e.count&&It("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),e.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new dn);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){Nt("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new N(-1/0,-1/0,-1/0),new N(1/0,1/0,1/0));return}if(t!==void 0){if(this.boundingBox.setFromBufferAttribute(t),e)for(let i=0,s=e.length;i<s;i++){let r=e[i];un.setFromBufferAttribute(r),this.morphTargetsRelative?(Pe.addVectors(this.boundingBox.min,un.min),this.boundingBox.expandByPoint(Pe),Pe.addVectors(this.boundingBox.max,un.max),this.boundingBox.expandByPoint(Pe)):(this.boundingBox.expandByPoint(un.min),this.boundingBox.expandByPoint(un.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&Nt('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new Dn);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){Nt("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new N,1/0);return}if(t){let i=this.boundingSphere.center;if(un.setFromBufferAttribute(t),e)for(let r=0,o=e.length;r<o;r++){let a=e[r];ro.setFromBufferAttribute(a),this.morphTargetsRelative?(Pe.addVectors(un.min,ro.min),un.expandByPoint(Pe),Pe.addVectors(un.max,ro.max),un.expandByPoint(Pe)):(un.expandByPoint(ro.min),un.expandByPoint(ro.max))}un.getCenter(i);let s=0;for(let r=0,o=t.count;r<o;r++)Pe.fromBufferAttribute(t,r),s=Math.max(s,i.distanceToSquared(Pe));if(e)for(let r=0,o=e.length;r<o;r++){let a=e[r],c=this.morphTargetsRelative;for(let l=0,h=a.count;l<h;l++)Pe.fromBufferAttribute(a,l),c&&(ar.fromBufferAttribute(t,l),Pe.add(ar)),s=Math.max(s,i.distanceToSquared(Pe))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&Nt('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let t=this.index,e=this.attributes;if(t===null||e.position===void 0||e.normal===void 0||e.uv===void 0){Nt("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let i=e.position,s=e.normal,r=e.uv,o=this.getAttribute("tangent");(o===void 0||o.count!==i.count)&&(o=new Ln(new Float32Array(4*i.count),4),this.setAttribute("tangent",o));let a=[],c=[],l=new Uint8Array(i.count);for(let D=0;D<i.count;D++)a[D]=new N,c[D]=new N;let h=new N,u=new N,f=new N,d=new Ct,g=new Ct,_=new Ct,m=new N,p=new N;function y(D,R,L){l[D]=l[R]=l[L]=1,h.fromBufferAttribute(i,D),u.fromBufferAttribute(i,R),f.fromBufferAttribute(i,L),d.fromBufferAttribute(r,D),g.fromBufferAttribute(r,R),_.fromBufferAttribute(r,L),u.sub(h),f.sub(h),g.sub(d),_.sub(d);let I=1/(g.x*_.y-_.x*g.y);isFinite(I)&&(m.copy(u).multiplyScalar(_.y).addScaledVector(f,-g.y).multiplyScalar(I),p.copy(f).multiplyScalar(g.x).addScaledVector(u,-_.x).multiplyScalar(I),a[D].add(m),a[R].add(m),a[L].add(m),c[D].add(p),c[R].add(p),c[L].add(p))}let b=this.groups;b.length===0&&(b=[{start:0,count:t.count}]);for(let D=0,R=b.length;D<R;++D){let L=b[D],I=L.start,z=L.count;for(let C=I,H=I+z;C<H;C+=3)y(t.getX(C+0),t.getX(C+1),t.getX(C+2))}let v=new N,A=new N,E=new N,x=new N;function w(D){E.fromBufferAttribute(s,D),x.copy(E);let R=a[D];v.copy(R),v.sub(E.multiplyScalar(E.dot(R))).normalize(),A.crossVectors(x,R);let I=A.dot(c[D])<0?-1:1;o.setXYZW(D,v.x,v.y,v.z,I)}for(let D=0,R=i.count;D<R;++D)l[D]&&w(D);this._transformed=!0}computeVertexNormals(){let t=this.index,e=this.getAttribute("position");if(e!==void 0){let i=this.getAttribute("normal");if(i===void 0||i.count!==e.count)i=new Ln(new Float32Array(e.count*3),3),this.setAttribute("normal",i);else for(let f=0,d=i.count;f<d;f++)i.setXYZ(f,0,0,0);let s=new N,r=new N,o=new N,a=new N,c=new N,l=new N,h=new N,u=new N;if(t)for(let f=0,d=t.count;f<d;f+=3){let g=t.getX(f+0),_=t.getX(f+1),m=t.getX(f+2);s.fromBufferAttribute(e,g),r.fromBufferAttribute(e,_),o.fromBufferAttribute(e,m),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),a.fromBufferAttribute(i,g),c.fromBufferAttribute(i,_),l.fromBufferAttribute(i,m),a.add(h),c.add(h),l.add(h),i.setXYZ(g,a.x,a.y,a.z),i.setXYZ(_,c.x,c.y,c.z),i.setXYZ(m,l.x,l.y,l.z)}else for(let f=0,d=e.count;f<d;f+=3)s.fromBufferAttribute(e,f+0),r.fromBufferAttribute(e,f+1),o.fromBufferAttribute(e,f+2),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),i.setXYZ(f+0,h.x,h.y,h.z),i.setXYZ(f+1,h.x,h.y,h.z),i.setXYZ(f+2,h.x,h.y,h.z);this.normalizeNormals(),i.needsUpdate=!0}}normalizeNormals(){let t=this.attributes.normal;for(let e=0,i=t.count;e<i;e++)Pe.fromBufferAttribute(t,e),Pe.normalize(),t.setXYZ(e,Pe.x,Pe.y,Pe.z)}toNonIndexed(){function t(a,c){let l=a.array,h=a.itemSize,u=a.normalized,f=new l.constructor(c.length*h),d=0,g=0;for(let _=0,m=c.length;_<m;_++){a.isInterleavedBufferAttribute?d=c[_]*a.data.stride+a.offset:d=c[_]*h;for(let p=0;p<h;p++)f[g++]=l[d++]}return new Ln(f,h,u)}if(this.index===null)return It("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let e=new n,i=this.index.array,s=this.attributes;for(let a in s){let c=s[a],l=t(c,i);e.setAttribute(a,l)}let r=this.morphAttributes;for(let a in r){let c=[],l=r[a];for(let h=0,u=l.length;h<u;h++){let f=l[h],d=t(f,i);c.push(d)}e.morphAttributes[a]=c}e.morphTargetsRelative=this.morphTargetsRelative;let o=this.groups;for(let a=0,c=o.length;a<c;a++){let l=o[a];e.addGroup(l.start,l.count,l.materialIndex)}return e}toJSON(){let t={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(t.uuid=this.uuid,t.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,t.name=this.name,Object.keys(this.userData).length>0&&(t.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let c=this.parameters;for(let l in c)c[l]!==void 0&&(t[l]=c[l]);return t}t.data={attributes:{}};let e=this.index;e!==null&&(t.data.index={type:e.array.constructor.name,array:Array.prototype.slice.call(e.array)});let i=this.attributes;for(let c in i){let l=i[c];t.data.attributes[c]=l.toJSON(t.data)}let s={},r=!1;for(let c in this.morphAttributes){let l=this.morphAttributes[c],h=[];for(let u=0,f=l.length;u<f;u++){let d=l[u];h.push(d.toJSON(t.data))}h.length>0&&(s[c]=h,r=!0)}r&&(t.data.morphAttributes=s,t.data.morphTargetsRelative=this.morphTargetsRelative);let o=this.groups;o.length>0&&(t.data.groups=JSON.parse(JSON.stringify(o)));let a=this.boundingSphere;return a!==null&&(t.data.boundingSphere=a.toJSON()),t}clone(){return new this.constructor().copy(this)}copy(t){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let e={};this.name=t.name;let i=t.index;i!==null&&this.setIndex(i.clone());let s=t.attributes;for(let l in s){let h=s[l];this.setAttribute(l,h.clone(e))}let r=t.morphAttributes;for(let l in r){let h=[],u=r[l];for(let f=0,d=u.length;f<d;f++)h.push(u[f].clone(e));this.morphAttributes[l]=h}this.morphTargetsRelative=t.morphTargetsRelative;let o=t.groups;for(let l=0,h=o.length;l<h;l++){let u=o[l];this.addGroup(u.start,u.count,u.materialIndex)}let a=t.boundingBox;a!==null&&(this.boundingBox=a.clone());let c=t.boundingSphere;return c!==null&&(this.boundingSphere=c.clone()),this.drawRange.start=t.drawRange.start,this.drawRange.count=t.drawRange.count,this.userData=t.userData,this._transformed=t._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}},Pl=class{constructor(t,e){this.isInterleavedBuffer=!0,this.array=t,this.stride=e,this.count=t!==void 0?t.length/e:0,this.usage=lf,this.updateRanges=[],this.version=0,this.uuid=Yi()}onUploadCallback(){}set needsUpdate(t){t===!0&&this.version++}setUsage(t){return this.usage=t,this}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}copy(t){return this.array=new t.array.constructor(t.array),this.count=t.count,this.stride=t.stride,this.usage=t.usage,this}copyAt(t,e,i){t*=this.stride,i*=e.stride;for(let s=0,r=this.stride;s<r;s++)this.array[t+s]=e.array[i+s];return this}set(t,e=0){return this.array.set(t,e),this}clone(t){t.arrayBuffers===void 0&&(t.arrayBuffers={});let e=Um(this.array);t.arrayBuffers[e]===void 0&&(t.arrayBuffers[e]=this.array.slice(0).buffer);let i=new this.array.constructor(t.arrayBuffers[e]),s=new this.constructor(i,this.stride);return s.setUsage(this.usage),s}onUpload(t){return this.onUploadCallback=t,this}toJSON(t){t.arrayBuffers===void 0&&(t.arrayBuffers={});let e=Um(this.array);t.arrayBuffers[e]===void 0&&(t.arrayBuffers[e]=Array.from(new Uint32Array(this.array.slice(0).buffer)));let i={uuid:this.uuid,buffer:e,type:this.array.constructor.name,stride:this.stride};return i.usage=this.usage,i}};function Um(n){return n.buffer._uuid===void 0&&(n.buffer._uuid=Yi()),n.byteOffset===0&&n.byteLength===n.buffer.byteLength?n.buffer._uuid:n.buffer._uuid+":"+n.byteOffset+":"+n.byteLength}var Ze=new N,Un=class n{constructor(t,e,i,s=!1){this.isInterleavedBufferAttribute=!0,this.name="",this.data=t,this.itemSize=e,this.offset=i,this.normalized=s,this._normalizationScale=t!==void 0?Bc(t.array):void 0}get count(){return this.data.count}get array(){return this.data.array}set needsUpdate(t){this.data.needsUpdate=t}applyMatrix4(t){for(let e=0,i=this.data.count;e<i;e++)Ze.fromBufferAttribute(this,e),Ze.applyMatrix4(t),this.setXYZ(e,Ze.x,Ze.y,Ze.z);return this}applyNormalMatrix(t){for(let e=0,i=this.count;e<i;e++)Ze.fromBufferAttribute(this,e),Ze.applyNormalMatrix(t),this.setXYZ(e,Ze.x,Ze.y,Ze.z);return this}transformDirection(t){for(let e=0,i=this.count;e<i;e++)Ze.fromBufferAttribute(this,e),Ze.transformDirection(t),this.setXYZ(e,Ze.x,Ze.y,Ze.z);return this}getComponent(t,e){let i=this.array[t*this.data.stride+this.offset+e];return this.normalized&&(i=this._denormalize(i)),i}setComponent(t,e,i){return this.normalized&&(i=this._normalize(i)),this.data.array[t*this.data.stride+this.offset+e]=i,this}setX(t,e){return this.normalized&&(e=this._normalize(e)),this.data.array[t*this.data.stride+this.offset]=e,this}setY(t,e){return this.normalized&&(e=this._normalize(e)),this.data.array[t*this.data.stride+this.offset+1]=e,this}setZ(t,e){return this.normalized&&(e=this._normalize(e)),this.data.array[t*this.data.stride+this.offset+2]=e,this}setW(t,e){return this.normalized&&(e=this._normalize(e)),this.data.array[t*this.data.stride+this.offset+3]=e,this}getX(t){let e=this.data.array[t*this.data.stride+this.offset];return this.normalized&&(e=this._denormalize(e)),e}getY(t){let e=this.data.array[t*this.data.stride+this.offset+1];return this.normalized&&(e=this._denormalize(e)),e}getZ(t){let e=this.data.array[t*this.data.stride+this.offset+2];return this.normalized&&(e=this._denormalize(e)),e}getW(t){let e=this.data.array[t*this.data.stride+this.offset+3];return this.normalized&&(e=this._denormalize(e)),e}setXY(t,e,i){return t=t*this.data.stride+this.offset,this.normalized&&(e=this._normalize(e),i=this._normalize(i)),this.data.array[t+0]=e,this.data.array[t+1]=i,this}setXYZ(t,e,i,s){return t=t*this.data.stride+this.offset,this.normalized&&(e=this._normalize(e),i=this._normalize(i),s=this._normalize(s)),this.data.array[t+0]=e,this.data.array[t+1]=i,this.data.array[t+2]=s,this}setXYZW(t,e,i,s,r){return t=t*this.data.stride+this.offset,this.normalized&&(e=this._normalize(e),i=this._normalize(i),s=this._normalize(s),r=this._normalize(r)),this.data.array[t+0]=e,this.data.array[t+1]=i,this.data.array[t+2]=s,this.data.array[t+3]=r,this}clone(t){if(t===void 0){po("InterleavedBufferAttribute.clone(): Cloning an interleaved buffer attribute will de-interleave buffer data.");let e=[];for(let i=0;i<this.count;i++){let s=i*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)e.push(this.data.array[s+r])}return new Ln(new this.array.constructor(e),this.itemSize,this.normalized)}else return t.interleavedBuffers===void 0&&(t.interleavedBuffers={}),t.interleavedBuffers[this.data.uuid]===void 0&&(t.interleavedBuffers[this.data.uuid]=this.data.clone(t)),new n(t.interleavedBuffers[this.data.uuid],this.itemSize,this.offset,this.normalized)}toJSON(t){if(t===void 0){po("InterleavedBufferAttribute.toJSON(): Serializing an interleaved buffer attribute will de-interleave buffer data.");let e=[];for(let i=0;i<this.count;i++){let s=i*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)e.push(this.data.array[s+r])}return{itemSize:this.itemSize,type:this.array.constructor.name,array:e,normalized:this.normalized}}else return t.interleavedBuffers===void 0&&(t.interleavedBuffers={}),t.interleavedBuffers[this.data.uuid]===void 0&&(t.interleavedBuffers[this.data.uuid]=this.data.toJSON(t)),{isInterleavedBufferAttribute:!0,itemSize:this.itemSize,data:this.data.uuid,offset:this.offset,normalized:this.normalized}}_denormalize(t){let e=this._normalizationScale;return e!==void 0?Math.max(t/e,-1):ff(t,this.data.array)}_normalize(t){let e=this._normalizationScale;return e!==void 0?Math.round(t*e):df(t,this.data.array)}},Mu=new N,kv=new N,zv=new Ut,Ke=class{constructor(t=new N(1,0,0),e=0){this.isPlane=!0,this.normal=t,this.constant=e}set(t,e){return this.normal.copy(t),this.constant=e,this}setComponents(t,e,i,s){return this.normal.set(t,e,i),this.constant=s,this}setFromNormalAndCoplanarPoint(t,e){return this.normal.copy(t),this.constant=-e.dot(this.normal),this}setFromCoplanarPoints(t,e,i){let s=Mu.subVectors(i,e).cross(kv.subVectors(t,e)).normalize();return this.setFromNormalAndCoplanarPoint(s,t),this}copy(t){return this.normal.copy(t.normal),this.constant=t.constant,this}normalize(){let t=1/this.normal.length();return this.normal.multiplyScalar(t),this.constant*=t,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(t){return this.normal.dot(t)+this.constant}distanceToSphere(t){return this.distanceToPoint(t.center)-t.radius}projectPoint(t,e){return e.copy(t).addScaledVector(this.normal,-this.distanceToPoint(t))}intersectLine(t,e,i=!0){let s=t.delta(Mu),r=this.normal.dot(s);if(r===0)return this.distanceToPoint(t.start)===0?e.copy(t.start):null;let o=-(t.start.dot(this.normal)+this.constant)/r;return i===!0&&(o<0||o>1)?null:e.copy(t.start).addScaledVector(s,o)}intersectsLine(t){let e=this.distanceToPoint(t.start),i=this.distanceToPoint(t.end);return e<0&&i>0||i<0&&e>0}intersectsBox(t){return t.intersectsPlane(this)}intersectsSphere(t){return t.intersectsPlane(this)}coplanarPoint(t){return t.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(t,e){let i=e||zv.getNormalMatrix(t),s=this.coplanarPoint(Mu).applyMatrix4(t),r=this.normal.applyMatrix3(i).normalize();return this.constant=-s.dot(r),this}translate(t){return this.constant-=t.dot(this.normal),this}equals(t){return t.normal.equals(this.normal)&&t.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(t){return this.normal.fromArray(t.normal),this.constant=t.constant,this}},Vv=0,vi=class extends Nn{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:Vv++}),this.uuid=Yi(),this.name="",this.type="Material",this.blending=Ar,this.side=$i,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=Vu,this.blendDst=Gu,this.blendEquation=Ms,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new zt(0,0,0),this.blendAlpha=0,this.depthFunc=mr,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=Tg,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=gl,this.stencilZFail=gl,this.stencilZPass=gl,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(t){this._alphaTest>0!=t>0&&this.version++,this._alphaTest=t}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(t){if(t!==void 0)for(let e in t){let i=t[e];if(i===void 0){It(`Material: parameter '${e}' has value of undefined.`);continue}let s=this[e];if(s===void 0){It(`Material: '${e}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(i):s&&s.isVector2&&i&&i.isVector2||s&&s.isEuler&&i&&i.isEuler||s&&s.isVector3&&i&&i.isVector3?s.copy(i):this[e]=i}}toJSON(t){let e=t===void 0||typeof t=="string";e&&(t={textures:{},images:{}});let i={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};i.uuid=this.uuid,i.type=this.type,i.blending=this.blending,i.side=this.side,i.shadowSide=this.shadowSide,i.vertexColors=this.vertexColors,i.opacity=this.opacity,i.transparent=this.transparent,i.blendSrc=this.blendSrc,i.blendDst=this.blendDst,i.blendEquation=this.blendEquation,i.blendSrcAlpha=this.blendSrcAlpha,i.blendDstAlpha=this.blendDstAlpha,i.blendEquationAlpha=this.blendEquationAlpha,i.blendColor=this.blendColor.getHex(),i.blendAlpha=this.blendAlpha,i.depthFunc=this.depthFunc,i.depthTest=this.depthTest,i.depthWrite=this.depthWrite,i.colorWrite=this.colorWrite,i.clipIntersection=this.clipIntersection,i.clipShadows=this.clipShadows,i.stencilWriteMask=this.stencilWriteMask,i.stencilFunc=this.stencilFunc,i.stencilRef=this.stencilRef,i.stencilFuncMask=this.stencilFuncMask,i.stencilFail=this.stencilFail,i.stencilZFail=this.stencilZFail,i.stencilZPass=this.stencilZPass,i.stencilWrite=this.stencilWrite,i.polygonOffset=this.polygonOffset,i.polygonOffsetFactor=this.polygonOffsetFactor,i.polygonOffsetUnits=this.polygonOffsetUnits,i.dithering=this.dithering,i.alphaTest=this.alphaTest,i.alphaHash=this.alphaHash,i.alphaToCoverage=this.alphaToCoverage,i.premultipliedAlpha=this.premultipliedAlpha,i.forceSinglePass=this.forceSinglePass,i.allowOverride=this.allowOverride,i.visible=this.visible,i.toneMapped=this.toneMapped,i.name=this.name,this.color&&this.color.isColor&&(i.color=this.color.getHex()),this.roughness!==void 0&&(i.roughness=this.roughness),this.metalness!==void 0&&(i.metalness=this.metalness),this.sheen!==void 0&&(i.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(i.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(i.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(i.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(i.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(i.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(i.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(i.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(i.shininess=this.shininess),this.clearcoat!==void 0&&(i.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(i.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(i.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(i.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(t).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(i.clearcoatMap=this.clearcoatMap.toJSON(t).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(i.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(t).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(i.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(t).uuid,i.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(i.sheenColorMap=this.sheenColorMap.toJSON(t).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(i.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(t).uuid),this.dispersion!==void 0&&(i.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(i.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(i.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(i.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(i.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(i.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(i.iridescenceMap=this.iridescenceMap.toJSON(t).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(i.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(t).uuid),this.anisotropy!==void 0&&(i.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(i.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(i.anisotropyMap=this.anisotropyMap.toJSON(t).uuid),this.map&&this.map.isTexture&&(i.map=this.map.toJSON(t).uuid),this.matcap&&this.matcap.isTexture&&(i.matcap=this.matcap.toJSON(t).uuid),this.alphaMap&&this.alphaMap.isTexture&&(i.alphaMap=this.alphaMap.toJSON(t).uuid),this.lightMap&&this.lightMap.isTexture&&(i.lightMap=this.lightMap.toJSON(t).uuid,i.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(i.aoMap=this.aoMap.toJSON(t).uuid,i.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(i.bumpMap=this.bumpMap.toJSON(t).uuid,i.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(i.normalMap=this.normalMap.toJSON(t).uuid,i.normalMapType=this.normalMapType,i.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(i.displacementMap=this.displacementMap.toJSON(t).uuid,i.displacementScale=this.displacementScale,i.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(i.roughnessMap=this.roughnessMap.toJSON(t).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(i.metalnessMap=this.metalnessMap.toJSON(t).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(i.emissiveMap=this.emissiveMap.toJSON(t).uuid),this.specularMap&&this.specularMap.isTexture&&(i.specularMap=this.specularMap.toJSON(t).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(i.specularIntensityMap=this.specularIntensityMap.toJSON(t).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(i.specularColorMap=this.specularColorMap.toJSON(t).uuid),this.envMap&&this.envMap.isTexture&&(i.envMap=this.envMap.toJSON(t).uuid,this.combine!==void 0&&(i.combine=this.combine)),this.envMapRotation!==void 0&&(i.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(i.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(i.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(i.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(i.gradientMap=this.gradientMap.toJSON(t).uuid),this.transmission!==void 0&&(i.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(i.transmissionMap=this.transmissionMap.toJSON(t).uuid),this.thickness!==void 0&&(i.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(i.thicknessMap=this.thicknessMap.toJSON(t).uuid),this.attenuationDistance!==void 0&&(i.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(i.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(i.size=this.size),this.sizeAttenuation!==void 0&&(i.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(i.clippingPlanes=this.clippingPlanes.map(r=>r.toJSON())),this.rotation!==void 0&&(i.rotation=this.rotation),this.depthPacking!==void 0&&(i.depthPacking=this.depthPacking),this.linewidth!==void 0&&(i.linewidth=this.linewidth),this.linecap!==void 0&&(i.linecap=this.linecap),this.linejoin!==void 0&&(i.linejoin=this.linejoin),this.dashSize!==void 0&&(i.dashSize=this.dashSize),this.gapSize!==void 0&&(i.gapSize=this.gapSize),this.scale!==void 0&&(i.scale=this.scale),this.wireframe!==void 0&&(i.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(i.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(i.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(i.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(i.flatShading=this.flatShading),this.fog!==void 0&&(i.fog=this.fog),Object.keys(this.userData).length>0&&(i.userData=this.userData);function s(r){let o=[];for(let a in r){let c=r[a];delete c.metadata,o.push(c)}return o}if(e){let r=s(t.textures),o=s(t.images);r.length>0&&(i.textures=r),o.length>0&&(i.images=o)}return i}fromJSON(t,e){if(t.uuid!==void 0&&(this.uuid=t.uuid),t.name!==void 0&&(this.name=t.name),t.color!==void 0&&this.color!==void 0&&this.color.setHex(t.color),t.roughness!==void 0&&(this.roughness=t.roughness),t.metalness!==void 0&&(this.metalness=t.metalness),t.sheen!==void 0&&(this.sheen=t.sheen),t.sheenColor!==void 0&&(this.sheenColor=new zt().setHex(t.sheenColor)),t.sheenRoughness!==void 0&&(this.sheenRoughness=t.sheenRoughness),t.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(t.emissive),t.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(t.specular),t.specularIntensity!==void 0&&(this.specularIntensity=t.specularIntensity),t.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(t.specularColor),t.shininess!==void 0&&(this.shininess=t.shininess),t.clearcoat!==void 0&&(this.clearcoat=t.clearcoat),t.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=t.clearcoatRoughness),t.diffuseRoughness!==void 0&&(this.diffuseRoughness=t.diffuseRoughness),t.dispersion!==void 0&&(this.dispersion=t.dispersion),t.retroreflectivity!==void 0&&(this.retroreflectivity=t.retroreflectivity),t.iridescence!==void 0&&(this.iridescence=t.iridescence),t.iridescenceIOR!==void 0&&(this.iridescenceIOR=t.iridescenceIOR),t.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessMinimum),t.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=t.iridescenceThicknessMaximum),t.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=t.iridescenceThicknessRange[1]),t.transmission!==void 0&&(this.transmission=t.transmission),t.thickness!==void 0&&(this.thickness=t.thickness),t.attenuationDistance!==void 0&&(this.attenuationDistance=t.attenuationDistance),t.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(t.attenuationColor),t.anisotropy!==void 0&&(this.anisotropy=t.anisotropy),t.anisotropyRotation!==void 0&&(this.anisotropyRotation=t.anisotropyRotation),t.fog!==void 0&&(this.fog=t.fog),t.flatShading!==void 0&&(this.flatShading=t.flatShading),t.blending!==void 0&&(this.blending=t.blending),t.combine!==void 0&&(this.combine=t.combine),t.side!==void 0&&(this.side=t.side),t.shadowSide!==void 0&&(this.shadowSide=t.shadowSide),t.opacity!==void 0&&(this.opacity=t.opacity),t.transparent!==void 0&&(this.transparent=t.transparent),t.alphaTest!==void 0&&(this.alphaTest=t.alphaTest),t.alphaHash!==void 0&&(this.alphaHash=t.alphaHash),t.depthFunc!==void 0&&(this.depthFunc=t.depthFunc),t.depthTest!==void 0&&(this.depthTest=t.depthTest),t.depthWrite!==void 0&&(this.depthWrite=t.depthWrite),t.colorWrite!==void 0&&(this.colorWrite=t.colorWrite),t.clippingPlanes!==void 0&&(this.clippingPlanes=t.clippingPlanes.map(i=>new Ke().fromJSON(i))),t.clipIntersection!==void 0&&(this.clipIntersection=t.clipIntersection),t.clipShadows!==void 0&&(this.clipShadows=t.clipShadows),t.depthPacking!==void 0&&(this.depthPacking=t.depthPacking),t.blendSrc!==void 0&&(this.blendSrc=t.blendSrc),t.blendDst!==void 0&&(this.blendDst=t.blendDst),t.blendEquation!==void 0&&(this.blendEquation=t.blendEquation),t.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=t.blendSrcAlpha),t.blendDstAlpha!==void 0&&(this.blendDstAlpha=t.blendDstAlpha),t.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=t.blendEquationAlpha),t.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(t.blendColor),t.blendAlpha!==void 0&&(this.blendAlpha=t.blendAlpha),t.stencilWriteMask!==void 0&&(this.stencilWriteMask=t.stencilWriteMask),t.stencilFunc!==void 0&&(this.stencilFunc=t.stencilFunc),t.stencilRef!==void 0&&(this.stencilRef=t.stencilRef),t.stencilFuncMask!==void 0&&(this.stencilFuncMask=t.stencilFuncMask),t.stencilFail!==void 0&&(this.stencilFail=t.stencilFail),t.stencilZFail!==void 0&&(this.stencilZFail=t.stencilZFail),t.stencilZPass!==void 0&&(this.stencilZPass=t.stencilZPass),t.stencilWrite!==void 0&&(this.stencilWrite=t.stencilWrite),t.wireframe!==void 0&&(this.wireframe=t.wireframe),t.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=t.wireframeLinewidth),t.wireframeLinecap!==void 0&&(this.wireframeLinecap=t.wireframeLinecap),t.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=t.wireframeLinejoin),t.rotation!==void 0&&(this.rotation=t.rotation),t.linewidth!==void 0&&(this.linewidth=t.linewidth),t.linecap!==void 0&&(this.linecap=t.linecap),t.linejoin!==void 0&&(this.linejoin=t.linejoin),t.dashSize!==void 0&&(this.dashSize=t.dashSize),t.gapSize!==void 0&&(this.gapSize=t.gapSize),t.scale!==void 0&&(this.scale=t.scale),t.polygonOffset!==void 0&&(this.polygonOffset=t.polygonOffset),t.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=t.polygonOffsetFactor),t.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=t.polygonOffsetUnits),t.dithering!==void 0&&(this.dithering=t.dithering),t.alphaToCoverage!==void 0&&(this.alphaToCoverage=t.alphaToCoverage),t.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=t.premultipliedAlpha),t.forceSinglePass!==void 0&&(this.forceSinglePass=t.forceSinglePass),t.allowOverride!==void 0&&(this.allowOverride=t.allowOverride),t.visible!==void 0&&(this.visible=t.visible),t.toneMapped!==void 0&&(this.toneMapped=t.toneMapped),t.userData!==void 0&&(this.userData=t.userData),t.vertexColors!==void 0&&(typeof t.vertexColors=="number"?this.vertexColors=t.vertexColors>0:this.vertexColors=t.vertexColors),t.size!==void 0&&(this.size=t.size),t.sizeAttenuation!==void 0&&(this.sizeAttenuation=t.sizeAttenuation),t.map!==void 0&&(this.map=e[t.map]||null),t.matcap!==void 0&&(this.matcap=e[t.matcap]||null),t.alphaMap!==void 0&&(this.alphaMap=e[t.alphaMap]||null),t.bumpMap!==void 0&&(this.bumpMap=e[t.bumpMap]||null),t.bumpScale!==void 0&&(this.bumpScale=t.bumpScale),t.normalMap!==void 0&&(this.normalMap=e[t.normalMap]||null),t.normalMapType!==void 0&&(this.normalMapType=t.normalMapType),t.normalScale!==void 0){let i=t.normalScale;Array.isArray(i)===!1&&(i=[i,i]),this.normalScale=new Ct().fromArray(i)}return t.displacementMap!==void 0&&(this.displacementMap=e[t.displacementMap]||null),t.displacementScale!==void 0&&(this.displacementScale=t.displacementScale),t.displacementBias!==void 0&&(this.displacementBias=t.displacementBias),t.roughnessMap!==void 0&&(this.roughnessMap=e[t.roughnessMap]||null),t.metalnessMap!==void 0&&(this.metalnessMap=e[t.metalnessMap]||null),t.emissiveMap!==void 0&&(this.emissiveMap=e[t.emissiveMap]||null),t.emissiveIntensity!==void 0&&(this.emissiveIntensity=t.emissiveIntensity),t.specularMap!==void 0&&(this.specularMap=e[t.specularMap]||null),t.specularIntensityMap!==void 0&&(this.specularIntensityMap=e[t.specularIntensityMap]||null),t.specularColorMap!==void 0&&(this.specularColorMap=e[t.specularColorMap]||null),t.envMap!==void 0&&(this.envMap=e[t.envMap]||null),t.envMapRotation!==void 0&&this.envMapRotation.fromArray(t.envMapRotation),t.envMapIntensity!==void 0&&(this.envMapIntensity=t.envMapIntensity),t.reflectivity!==void 0&&(this.reflectivity=t.reflectivity),t.refractionRatio!==void 0&&(this.refractionRatio=t.refractionRatio),t.lightMap!==void 0&&(this.lightMap=e[t.lightMap]||null),t.lightMapIntensity!==void 0&&(this.lightMapIntensity=t.lightMapIntensity),t.aoMap!==void 0&&(this.aoMap=e[t.aoMap]||null),t.aoMapIntensity!==void 0&&(this.aoMapIntensity=t.aoMapIntensity),t.gradientMap!==void 0&&(this.gradientMap=e[t.gradientMap]||null),t.clearcoatMap!==void 0&&(this.clearcoatMap=e[t.clearcoatMap]||null),t.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=e[t.clearcoatRoughnessMap]||null),t.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=e[t.clearcoatNormalMap]||null),t.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new Ct().fromArray(t.clearcoatNormalScale)),t.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=e[t.diffuseRoughnessMap]||null),t.iridescenceMap!==void 0&&(this.iridescenceMap=e[t.iridescenceMap]||null),t.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=e[t.iridescenceThicknessMap]||null),t.transmissionMap!==void 0&&(this.transmissionMap=e[t.transmissionMap]||null),t.thicknessMap!==void 0&&(this.thicknessMap=e[t.thicknessMap]||null),t.anisotropyMap!==void 0&&(this.anisotropyMap=e[t.anisotropyMap]||null),t.sheenColorMap!==void 0&&(this.sheenColorMap=e[t.sheenColorMap]||null),t.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=e[t.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(t){this.name=t.name,this.blending=t.blending,this.side=t.side,this.vertexColors=t.vertexColors,this.opacity=t.opacity,this.transparent=t.transparent,this.blendSrc=t.blendSrc,this.blendDst=t.blendDst,this.blendEquation=t.blendEquation,this.blendSrcAlpha=t.blendSrcAlpha,this.blendDstAlpha=t.blendDstAlpha,this.blendEquationAlpha=t.blendEquationAlpha,this.blendColor.copy(t.blendColor),this.blendAlpha=t.blendAlpha,this.depthFunc=t.depthFunc,this.depthTest=t.depthTest,this.depthWrite=t.depthWrite,this.stencilWriteMask=t.stencilWriteMask,this.stencilFunc=t.stencilFunc,this.stencilRef=t.stencilRef,this.stencilFuncMask=t.stencilFuncMask,this.stencilFail=t.stencilFail,this.stencilZFail=t.stencilZFail,this.stencilZPass=t.stencilZPass,this.stencilWrite=t.stencilWrite;let e=t.clippingPlanes,i=null;if(e!==null){let s=e.length;i=new Array(s);for(let r=0;r!==s;++r)i[r]=e[r].clone()}return this.clippingPlanes=i,this.clipIntersection=t.clipIntersection,this.clipShadows=t.clipShadows,this.shadowSide=t.shadowSide,this.colorWrite=t.colorWrite,this.precision=t.precision,this.polygonOffset=t.polygonOffset,this.polygonOffsetFactor=t.polygonOffsetFactor,this.polygonOffsetUnits=t.polygonOffsetUnits,this.dithering=t.dithering,this.alphaTest=t.alphaTest,this.alphaHash=t.alphaHash,this.alphaToCoverage=t.alphaToCoverage,this.premultipliedAlpha=t.premultipliedAlpha,this.forceSinglePass=t.forceSinglePass,this.allowOverride=t.allowOverride,this.visible=t.visible,this.toneMapped=t.toneMapped,this.userData=JSON.parse(JSON.stringify(t.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(t){t===!0&&this.version++}};var mi=new N,Su=new N,Ja=new N,Ka=new N,Fi=class{constructor(t=new N,e=new N(0,0,-1)){this.origin=t,this.direction=e}set(t,e){return this.origin.copy(t),this.direction.copy(e),this}copy(t){return this.origin.copy(t.origin),this.direction.copy(t.direction),this}at(t,e){return e.copy(this.origin).addScaledVector(this.direction,t)}lookAt(t){return this.direction.copy(t).sub(this.origin).normalize(),this}recast(t){return this.origin.copy(this.at(t,mi)),this}closestPointToPoint(t,e){e.subVectors(t,this.origin);let i=e.dot(this.direction);return i<0?e.copy(this.origin):e.copy(this.origin).addScaledVector(this.direction,i)}distanceToPoint(t){return Math.sqrt(this.distanceSqToPoint(t))}distanceSqToPoint(t){let e=mi.subVectors(t,this.origin).dot(this.direction);return e<0?this.origin.distanceToSquared(t):(mi.copy(this.origin).addScaledVector(this.direction,e),mi.distanceToSquared(t))}distanceSqToSegment(t,e,i,s){Su.copy(t).add(e).multiplyScalar(.5),Ja.copy(e).sub(t).normalize(),Ka.copy(this.origin).sub(Su);let r=t.distanceTo(e)*.5,o=-this.direction.dot(Ja),a=Ka.dot(this.direction),c=-Ka.dot(Ja),l=Ka.lengthSq(),h=Math.abs(1-o*o),u,f,d,g;if(h>0)if(u=o*c-a,f=o*a-c,g=r*h,u>=0)if(f>=-g)if(f<=g){let _=1/h;u*=_,f*=_,d=u*(u+o*f+2*a)+f*(o*u+f+2*c)+l}else f=r,u=Math.max(0,-(o*f+a)),d=-u*u+f*(f+2*c)+l;else f=-r,u=Math.max(0,-(o*f+a)),d=-u*u+f*(f+2*c)+l;else f<=-g?(u=Math.max(0,-(-o*r+a)),f=u>0?-r:Math.min(Math.max(-r,-c),r),d=-u*u+f*(f+2*c)+l):f<=g?(u=0,f=Math.min(Math.max(-r,-c),r),d=f*(f+2*c)+l):(u=Math.max(0,-(o*r+a)),f=u>0?r:Math.min(Math.max(-r,-c),r),d=-u*u+f*(f+2*c)+l);else f=o>0?-r:r,u=Math.max(0,-(o*f+a)),d=-u*u+f*(f+2*c)+l;return i&&i.copy(this.origin).addScaledVector(this.direction,u),s&&s.copy(Su).addScaledVector(Ja,f),d}intersectSphere(t,e){if(t.radius<0)return null;mi.subVectors(t.center,this.origin);let i=mi.dot(this.direction),s=mi.dot(mi)-i*i,r=t.radius*t.radius;if(s>r)return null;let o=Math.sqrt(r-s),a=i-o,c=i+o;return c<0?null:a<0?this.at(c,e):this.at(a,e)}intersectsSphere(t){return t.radius<0?!1:this.distanceSqToPoint(t.center)<=t.radius*t.radius}distanceToPlane(t){let e=t.normal.dot(this.direction);if(e===0)return t.distanceToPoint(this.origin)===0?0:null;let i=-(this.origin.dot(t.normal)+t.constant)/e;return i>=0?i:null}intersectPlane(t,e){let i=this.distanceToPlane(t);return i===null?null:this.at(i,e)}intersectsPlane(t){let e=t.distanceToPoint(this.origin);return e===0||t.normal.dot(this.direction)*e<0}intersectBox(t,e){let i,s,r,o,a,c,l=1/this.direction.x,h=1/this.direction.y,u=1/this.direction.z,f=this.origin;return l>=0?(i=(t.min.x-f.x)*l,s=(t.max.x-f.x)*l):(i=(t.max.x-f.x)*l,s=(t.min.x-f.x)*l),h>=0?(r=(t.min.y-f.y)*h,o=(t.max.y-f.y)*h):(r=(t.max.y-f.y)*h,o=(t.min.y-f.y)*h),i>o||r>s||((r>i||isNaN(i))&&(i=r),(o<s||isNaN(s))&&(s=o),u>=0?(a=(t.min.z-f.z)*u,c=(t.max.z-f.z)*u):(a=(t.max.z-f.z)*u,c=(t.min.z-f.z)*u),i>c||a>s)||((a>i||i!==i)&&(i=a),(c<s||s!==s)&&(s=c),s<0)?null:this.at(i>=0?i:s,e)}intersectsBox(t){return this.intersectBox(t,mi)!==null}intersectTriangle(t,e,i,s,r){let o=this.origin,a=this.direction,c=a.x,l=a.y,h=a.z,u=t.x-o.x,f=t.y-o.y,d=t.z-o.z,g=e.x-o.x,_=e.y-o.y,m=e.z-o.z,p=i.x-o.x,y=i.y-o.y,b=i.z-o.z,v=Math.abs(c),A=Math.abs(l),E=Math.abs(h),x,w,D,R,L,I,z,C,H,q,V,j;if(v>=A&&v>=E?(D=c,I=u,H=g,j=p,c>=0?(x=l,w=h,R=f,L=d,z=_,C=m,q=y,V=b):(x=h,w=l,R=d,L=f,z=m,C=_,q=b,V=y)):A>=E?(D=l,I=f,H=_,j=y,l>=0?(x=h,w=c,R=d,L=u,z=m,C=g,q=b,V=p):(x=c,w=h,R=u,L=d,z=g,C=m,q=p,V=b)):(D=h,I=d,H=m,j=b,h>=0?(x=c,w=l,R=u,L=f,z=g,C=_,q=p,V=y):(x=l,w=c,R=f,L=u,z=_,C=g,q=y,V=p)),D===0)return null;let X=x/D,Y=w/D,st=1/D,O=R-X*I,Z=L-Y*I,B=z-X*H,et=C-Y*H,it=q-X*j,ot=V-Y*j,rt=it*et-ot*B,Mt=O*ot-Z*it,Wt=B*Z-et*O;if(s){if(rt<0||Mt<0||Wt<0)return null}else if((rt<0||Mt<0||Wt<0)&&(rt>0||Mt>0||Wt>0))return null;let At=rt+Mt+Wt;if(At===0)return null;let Dt=st*(rt*I+Mt*H+Wt*j);return(At>0?Dt<0:Dt>0)?null:this.at(Dt/At,r)}applyMatrix4(t){return this.origin.applyMatrix4(t),this.direction.transformDirection(t),this}equals(t){return t.origin.equals(this.origin)&&t.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},On=class extends vi{constructor(t){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new zt(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new yi,this.combine=Kl,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.fog=t.fog,this}},Om=new se,ms=new Fi,ja=new Dn,Fm=new N,Qa=new N,tl=new N,el=new N,wu=new N,nl=new N,Bm=new N,il=new N,_e=class extends $e{constructor(t=new he,e=new On){super(),this.isMesh=!0,this.type="Mesh",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}updateMorphTargets(){let e=this.geometry.morphAttributes,i=Object.keys(e);if(i.length>0){let s=e[i[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}getVertexPosition(t,e){let i=this.geometry,s=i.attributes.position,r=i.morphAttributes.position,o=i.morphTargetsRelative;e.fromBufferAttribute(s,t);let a=this.morphTargetInfluences;if(r&&a){nl.set(0,0,0);for(let c=0,l=r.length;c<l;c++){let h=a[c],u=r[c];h!==0&&(wu.fromBufferAttribute(u,t),o?nl.addScaledVector(wu,h):nl.addScaledVector(wu.sub(e),h))}e.add(nl)}return e}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let i=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(i.boundingSphere===null&&i.computeBoundingSphere(),ja.copy(i.boundingSphere),ja.applyMatrix4(r),ms.copy(t.ray).recast(t.near),!(ja.containsPoint(ms.origin)===!1&&(ms.intersectSphere(ja,Fm)===null||ms.origin.distanceToSquared(Fm)>(t.far-t.near)**2))&&(Om.copy(r).invert(),ms.copy(t.ray).applyMatrix4(Om),!(i.boundingBox!==null&&ms.intersectsBox(i.boundingBox)===!1)&&this._computeIntersections(t,e,ms)))}_computeIntersections(t,e,i){let s,r=this.geometry,o=this.material,a=r.index,c=r.attributes.position,l=r.attributes.uv,h=r.attributes.uv1,u=r.attributes.normal,f=r.groups,d=r.drawRange;if(a!==null)if(Array.isArray(o))for(let g=0,_=f.length;g<_;g++){let m=f[g],p=o[m.materialIndex],y=Math.max(m.start,d.start),b=Math.min(a.count,Math.min(m.start+m.count,d.start+d.count));for(let v=y,A=b;v<A;v+=3){let E=a.getX(v),x=a.getX(v+1),w=a.getX(v+2);s=sl(this,p,t,i,l,h,u,E,x,w),s&&(s.faceIndex=Math.floor(v/3),s.face.materialIndex=m.materialIndex,e.push(s))}}else{let g=Math.max(0,d.start),_=Math.min(a.count,d.start+d.count);for(let m=g,p=_;m<p;m+=3){let y=a.getX(m),b=a.getX(m+1),v=a.getX(m+2);s=sl(this,o,t,i,l,h,u,y,b,v),s&&(s.faceIndex=Math.floor(m/3),e.push(s))}}else if(c!==void 0)if(Array.isArray(o))for(let g=0,_=f.length;g<_;g++){let m=f[g],p=o[m.materialIndex],y=Math.max(m.start,d.start),b=Math.min(c.count,Math.min(m.start+m.count,d.start+d.count));for(let v=y,A=b;v<A;v+=3){let E=v,x=v+1,w=v+2;s=sl(this,p,t,i,l,h,u,E,x,w),s&&(s.faceIndex=Math.floor(v/3),s.face.materialIndex=m.materialIndex,e.push(s))}}else{let g=Math.max(0,d.start),_=Math.min(c.count,d.start+d.count);for(let m=g,p=_;m<p;m+=3){let y=m,b=m+1,v=m+2;s=sl(this,o,t,i,l,h,u,y,b,v),s&&(s.faceIndex=Math.floor(m/3),e.push(s))}}}};function Gv(n,t,e,i,s,r,o,a){let c;if(t.side===De?c=i.intersectTriangle(o,r,s,!0,a):c=i.intersectTriangle(s,r,o,t.side===$i,a),c===null)return null;il.copy(a),il.applyMatrix4(n.matrixWorld);let l=e.ray.origin.distanceTo(il);return l<e.near||l>e.far?null:{distance:l,point:il.clone(),object:n}}function sl(n,t,e,i,s,r,o,a,c,l){n.getVertexPosition(a,Qa),n.getVertexPosition(c,tl),n.getVertexPosition(l,el);let h=Gv(n,t,e,i,Qa,tl,el,Bm);if(h){let u=new N;gi.getBarycoord(Bm,Qa,tl,el,u),s&&(h.uv=gi.getInterpolatedAttribute(s,a,c,l,u,new Ct)),r&&(h.uv1=gi.getInterpolatedAttribute(r,a,c,l,u,new Ct)),o&&(h.normal=gi.getInterpolatedAttribute(o,a,c,l,u,new N),h.normal.dot(i.direction)>0&&h.normal.multiplyScalar(-1));let f={a,b:c,c:l,normal:new N,materialIndex:0};gi.getNormal(Qa,tl,el,f.normal),h.face=f,h.barycoord=u}return h}var Il=class extends tn{constructor(t=null,e=1,i=1,s,r,o,a,c,l=Ie,h=Ie,u,f){super(null,o,a,c,l,h,s,r,u,f),this.isDataTexture=!0,this.image={data:t,width:e,height:i},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}};var gs=new Dn,Hv=new Ct(.5,.5),rl=new N,Bi=class{constructor(t=new Ke,e=new Ke,i=new Ke,s=new Ke,r=new Ke,o=new Ke){this.planes=[t,e,i,s,r,o]}set(t,e,i,s,r,o){let a=this.planes;return a[0].copy(t),a[1].copy(e),a[2].copy(i),a[3].copy(s),a[4].copy(r),a[5].copy(o),this}copy(t){let e=this.planes;for(let i=0;i<6;i++)e[i].copy(t.planes[i]);return this}setFromProjectionMatrix(t,e=bn,i=!1){let s=this.planes,r=t.elements,o=r[0],a=r[1],c=r[2],l=r[3],h=r[4],u=r[5],f=r[6],d=r[7],g=r[8],_=r[9],m=r[10],p=r[11],y=r[12],b=r[13],v=r[14],A=r[15];if(s[0].setComponents(l-o,d-h,p-g,A-y).normalize(),s[1].setComponents(l+o,d+h,p+g,A+y).normalize(),s[2].setComponents(l+a,d+u,p+_,A+b).normalize(),s[3].setComponents(l-a,d-u,p-_,A-b).normalize(),i)s[4].setComponents(c,f,m,v).normalize(),s[5].setComponents(l-c,d-f,p-m,A-v).normalize();else if(s[4].setComponents(l-c,d-f,p-m,A-v).normalize(),e===bn)s[5].setComponents(l+c,d+f,p+m,A+v).normalize();else if(e===gr)s[5].setComponents(c,f,m,v).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+e);return this}intersectsObject(t){if(t.boundingSphere!==void 0)t.boundingSphere===null&&t.computeBoundingSphere(),gs.copy(t.boundingSphere).applyMatrix4(t.matrixWorld);else{let e=t.geometry;e.boundingSphere===null&&e.computeBoundingSphere(),gs.copy(e.boundingSphere).applyMatrix4(t.matrixWorld)}return this.intersectsSphere(gs)}intersectsSprite(t){gs.center.set(0,0,0);let e=Hv.distanceTo(t.center);return gs.radius=.7071067811865476+e,gs.applyMatrix4(t.matrixWorld),this.intersectsSphere(gs)}intersectsSphere(t){let e=this.planes,i=t.center,s=-t.radius;for(let r=0;r<6;r++)if(e[r].distanceToPoint(i)<s)return!1;return!0}intersectsBox(t){let e=this.planes;for(let i=0;i<6;i++){let s=e[i];if(rl.x=s.normal.x>0?t.max.x:t.min.x,rl.y=s.normal.y>0?t.max.y:t.min.y,rl.z=s.normal.z>0?t.max.z:t.min.z,s.distanceToPoint(rl)<0)return!1}return!0}containsPoint(t){let e=this.planes;for(let i=0;i<6;i++)if(e[i].distanceToPoint(t)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},km=new se,Ll=class n{constructor(){this.coordinateSystem=bn,this._frustums=[],this._count=0}setFromArrayCamera(t){let e=t.cameras,i=this._frustums;for(let s=0;s<e.length;s++){let r=e[s];km.multiplyMatrices(r.projectionMatrix,r.matrixWorldInverse),i[s]===void 0&&(i[s]=new Bi),i[s].setFromProjectionMatrix(km,r.coordinateSystem,r.reversedDepth)}return this._count=e.length,this}getFrustum(t){return this._frustums[t]}intersectsObject(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].intersectsObject(t))return!0;return!1}intersectsSprite(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].intersectsSprite(t))return!0;return!1}intersectsSphere(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].intersectsSphere(t))return!0;return!1}intersectsBox(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].intersectsBox(t))return!0;return!1}containsPoint(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].containsPoint(t))return!0;return!1}copy(t){this.coordinateSystem=t.coordinateSystem;let e=this._frustums,i=t._frustums;for(let s=0;s<t._count;s++)e[s]===void 0&&(e[s]=new Bi),e[s].copy(i[s]);return this._count=t._count,this}clone(){return new n().copy(this)}};var Yn=class extends vi{constructor(t){super(),this.isLineBasicMaterial=!0,this.type="LineBasicMaterial",this.color=new zt(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.linewidth=t.linewidth,this.linecap=t.linecap,this.linejoin=t.linejoin,this.fog=t.fog,this}},Nl=new N,Dl=new N,zm=new se,oo=new Fi,ol=new Dn,Eu=new N,Vm=new N,Ul=class extends $e{constructor(t=new he,e=new Yn){super(),this.isLine=!0,this.type="Line",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}computeLineDistances(){let t=this.geometry;if(t.index===null){let e=t.attributes.position,i=[0];for(let s=1,r=e.count;s<r;s++)Nl.fromBufferAttribute(e,s-1),Dl.fromBufferAttribute(e,s),i[s]=i[s-1],i[s]+=Nl.distanceTo(Dl);t.setAttribute("lineDistance",new Ht(i,1))}else It("Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let i=this.geometry,s=this.matrixWorld,r=t.params.Line.threshold,o=i.drawRange;if(i.boundingSphere===null&&i.computeBoundingSphere(),ol.copy(i.boundingSphere),ol.applyMatrix4(s),ol.radius+=r,t.ray.intersectsSphere(ol)===!1)return;zm.copy(s).invert(),oo.copy(t.ray).applyMatrix4(zm);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),c=a*a,l=this.isLineSegments?2:1,h=i.index,f=i.attributes.position;if(h!==null){let d=Math.max(0,o.start),g=Math.min(h.count,o.start+o.count);for(let _=d,m=g-1;_<m;_+=l){let p=h.getX(_),y=h.getX(_+1),b=al(this,t,oo,c,p,y,_);b&&e.push(b)}if(this.isLineLoop){let _=h.getX(g-1),m=h.getX(d),p=al(this,t,oo,c,_,m,g-1);p&&e.push(p)}}else{let d=Math.max(0,o.start),g=Math.min(f.count,o.start+o.count);for(let _=d,m=g-1;_<m;_+=l){let p=al(this,t,oo,c,_,_+1,_);p&&e.push(p)}if(this.isLineLoop){let _=al(this,t,oo,c,g-1,d,g-1);_&&e.push(_)}}}updateMorphTargets(){let e=this.geometry.morphAttributes,i=Object.keys(e);if(i.length>0){let s=e[i[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function al(n,t,e,i,s,r,o){let a=n.geometry.attributes.position;if(Nl.fromBufferAttribute(a,s),Dl.fromBufferAttribute(a,r),e.distanceSqToSegment(Nl,Dl,Eu,Vm)>i)return;Eu.applyMatrix4(n.matrixWorld);let l=t.ray.origin.distanceTo(Eu);if(!(l<t.near||l>t.far))return{distance:l,point:Vm.clone().applyMatrix4(n.matrixWorld),index:o,face:null,faceIndex:null,barycoord:null,object:n}}var Gm=new N,Hm=new N,bi=class extends Ul{constructor(t,e){super(t,e),this.isLineSegments=!0,this.type="LineSegments"}computeLineDistances(){let t=this.geometry;if(t.index===null){let e=t.attributes.position,i=[];for(let s=0,r=e.count;s<r;s+=2)Gm.fromBufferAttribute(e,s),Hm.fromBufferAttribute(e,s+1),i[s]=s===0?0:i[s-1],i[s+1]=i[s]+Gm.distanceTo(Hm);t.setAttribute("lineDistance",new Ht(i,1))}else It("LineSegments.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}};var yo=class extends tn{constructor(t=[],e=Ss,i,s,r,o,a,c,l,h){super(t,e,i,s,r,o,a,c,l,h),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(t){this.image=t}},Mr=class extends tn{constructor(t,e,i,s,r,o,a,c,l){super(t,e,i,s,r,o,a,c,l),this.isCanvasTexture=!0,this.needsUpdate=!0}};var Mi=class extends tn{constructor(t,e,i=Fn,s,r,o,a=Ie,c=Ie,l,h=xi,u=1){if(h!==xi&&h!==Ei)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let f={width:t,height:e,depth:u};super(f,s,r,o,a,c,h,i,l),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(t){return super.copy(t),this.source=new yr(Object.assign({},t.image)),this.compareFunction=t.compareFunction,this}toJSON(t){let e=super.toJSON(t);return e.compareFunction=this.compareFunction,e}},vo=class extends Mi{constructor(t,e=Fn,i=Ss,s,r,o=Ie,a=Ie,c,l=xi){let h={width:t,height:t,depth:1},u=[h,h,h,h,h,h];super(t,t,e,i,s,r,o,a,c,l),this.image=u,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(t){this.image=t}},bo=class extends tn{constructor(t=null){super(),this.sourceTexture=t,this.isExternalTexture=!0}copy(t){return super.copy(t),this.sourceTexture=t.sourceTexture,this}},Si=class n extends he{constructor(t=1,e=1,i=1,s=1,r=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:t,height:e,depth:i,widthSegments:s,heightSegments:r,depthSegments:o};let a=this;s=Math.floor(s),r=Math.floor(r),o=Math.floor(o);let c=[],l=[],h=[],u=[],f=0,d=0;g("z","y","x",-1,-1,i,e,t,o,r,0),g("z","y","x",1,-1,i,e,-t,o,r,1),g("x","z","y",1,1,t,i,e,s,o,2),g("x","z","y",1,-1,t,i,-e,s,o,3),g("x","y","z",1,-1,t,e,i,s,r,4),g("x","y","z",-1,-1,t,e,-i,s,r,5),this.setIndex(c),this.setAttribute("position",new Ht(l,3)),this.setAttribute("normal",new Ht(h,3)),this.setAttribute("uv",new Ht(u,2));function g(_,m,p,y,b,v,A,E,x,w,D){let R=v/x,L=A/w,I=v/2,z=A/2,C=E/2,H=x+1,q=w+1,V=0,j=0,X=new N;for(let Y=0;Y<q;Y++){let st=Y*L-z;for(let O=0;O<H;O++){let Z=O*R-I;X[_]=Z*y,X[m]=st*b,X[p]=C,l.push(X.x,X.y,X.z),X[_]=0,X[m]=0,X[p]=E>0?1:-1,h.push(X.x,X.y,X.z),u.push(O/x),u.push(1-Y/w),V+=1}}for(let Y=0;Y<w;Y++)for(let st=0;st<x;st++){let O=f+st+H*Y,Z=f+st+H*(Y+1),B=f+(st+1)+H*(Y+1),et=f+(st+1)+H*Y;c.push(O,Z,et),c.push(Z,B,et),j+=6}a.addGroup(d,j,D),d+=j,f+=V}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new n(t.width,t.height,t.depth,t.widthSegments,t.heightSegments,t.depthSegments)}};var Mo=class n extends he{constructor(t=1,e=32,i=0,s=Math.PI*2){super(),this.type="CircleGeometry",this.parameters={radius:t,segments:e,thetaStart:i,thetaLength:s},e=Math.max(3,e);let r=[],o=[],a=[],c=[],l=new N,h=new Ct;o.push(0,0,0),a.push(0,0,1),c.push(.5,.5);for(let u=0,f=3;u<=e;u++,f+=3){let d=i+u/e*s;l.x=t*Math.cos(d),l.y=t*Math.sin(d),o.push(l.x,l.y,l.z),a.push(0,0,1),h.x=(o[f]/t+1)/2,h.y=(o[f+1]/t+1)/2,c.push(h.x,h.y)}for(let u=1;u<=e;u++)r.push(u,u+1,0);this.setIndex(r),this.setAttribute("position",new Ht(o,3)),this.setAttribute("normal",new Ht(a,3)),this.setAttribute("uv",new Ht(c,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new n(t.radius,t.segments,t.thetaStart,t.thetaLength)}},ki=class n extends he{constructor(t=1,e=1,i=1,s=32,r=1,o=!1,a=0,c=Math.PI*2){super(),this.type="CylinderGeometry",this.parameters={radiusTop:t,radiusBottom:e,height:i,radialSegments:s,heightSegments:r,openEnded:o,thetaStart:a,thetaLength:c};let l=this;s=Math.floor(s),r=Math.floor(r);let h=[],u=[],f=[],d=[],g=0,_=[],m=i/2,p=0;y(),o===!1&&(t>0&&b(!0),e>0&&b(!1)),this.setIndex(h),this.setAttribute("position",new Ht(u,3)),this.setAttribute("normal",new Ht(f,3)),this.setAttribute("uv",new Ht(d,2));function y(){let v=new N,A=new N,E=0,x=(e-t)/i;for(let w=0;w<=r;w++){let D=[],R=w/r,L=R*(e-t)+t;for(let I=0;I<=s;I++){let z=I/s,C=z*c+a,H=Math.sin(C),q=Math.cos(C);A.x=L*H,A.y=-R*i+m,A.z=L*q,u.push(A.x,A.y,A.z),v.set(H,x,q).normalize(),f.push(v.x,v.y,v.z),d.push(z,1-R),D.push(g++)}_.push(D)}for(let w=0;w<s;w++)for(let D=0;D<r;D++){let R=_[D][w],L=_[D+1][w],I=_[D+1][w+1],z=_[D][w+1];(t>0||D!==0)&&(h.push(R,L,z),E+=3),(e>0||D!==r-1)&&(h.push(L,I,z),E+=3)}l.addGroup(p,E,0),p+=E}function b(v){let A=g,E=new Ct,x=new N,w=0,D=v===!0?t:e,R=v===!0?1:-1;for(let I=1;I<=s;I++)u.push(0,m*R,0),f.push(0,R,0),d.push(.5,.5),g++;let L=g;for(let I=0;I<=s;I++){let C=I/s*c+a,H=Math.cos(C),q=Math.sin(C);x.x=D*q,x.y=m*R,x.z=D*H,u.push(x.x,x.y,x.z),f.push(0,R,0),E.x=H*.5+.5,E.y=q*.5*R+.5,d.push(E.x,E.y),g++}for(let I=0;I<s;I++){let z=A+I,C=L+I;v===!0?h.push(C,C+1,z):h.push(C+1,C,z),w+=3}l.addGroup(p,w,v===!0?1:2),p+=w}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new n(t.radiusTop,t.radiusBottom,t.height,t.radialSegments,t.heightSegments,t.openEnded,t.thetaStart,t.thetaLength)}},So=class n extends ki{constructor(t=1,e=1,i=32,s=1,r=!1,o=0,a=Math.PI*2){super(0,t,e,i,s,r,o,a),this.type="ConeGeometry",this.parameters={radius:t,height:e,radialSegments:i,heightSegments:s,openEnded:r,thetaStart:o,thetaLength:a}}static fromJSON(t){return new n(t.radius,t.height,t.radialSegments,t.heightSegments,t.openEnded,t.thetaStart,t.thetaLength)}};var ll=new N,cl=new N,Au=new N,hl=new gi,wo=class extends he{constructor(t=null,e=1){if(super(),this.type="EdgesGeometry",this.parameters={geometry:t,thresholdAngle:e},t!==null){let s=Math.pow(10,4),r=Math.cos(dr*e),o=t.getIndex(),a=t.getAttribute("position"),c=o?o.count:a.count,l=[0,0,0],h=["a","b","c"],u=new Array(3),f=new Map,d=[];for(let g=0;g<c;g+=3){o?(l[0]=o.getX(g),l[1]=o.getX(g+1),l[2]=o.getX(g+2)):(l[0]=g,l[1]=g+1,l[2]=g+2);let{a:_,b:m,c:p}=hl;if(_.fromBufferAttribute(a,l[0]),m.fromBufferAttribute(a,l[1]),p.fromBufferAttribute(a,l[2]),hl.getNormal(Au),u[0]=`${Math.round(_.x*s)},${Math.round(_.y*s)},${Math.round(_.z*s)}`,u[1]=`${Math.round(m.x*s)},${Math.round(m.y*s)},${Math.round(m.z*s)}`,u[2]=`${Math.round(p.x*s)},${Math.round(p.y*s)},${Math.round(p.z*s)}`,!(u[0]===u[1]||u[1]===u[2]||u[2]===u[0]))for(let y=0;y<3;y++){let b=(y+1)%3,v=u[y],A=u[b],E=hl[h[y]],x=hl[h[b]],w=`${v}_${A}`,D=`${A}_${v}`,R=f.get(D);R?(Au.dot(R.normal)<=r&&(d.push(E.x,E.y,E.z),d.push(x.x,x.y,x.z)),f.set(D,null)):f.has(w)||f.set(w,{index0:l[y],index1:l[b],normal:Au.clone()})}}for(let g of f.values())if(g){let{index0:_,index1:m}=g;ll.fromBufferAttribute(a,_),cl.fromBufferAttribute(a,m),d.push(ll.x,ll.y,ll.z),d.push(cl.x,cl.y,cl.z)}this.setAttribute("position",new Ht(d,3))}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}};var _s=class n extends he{constructor(t=1,e=1,i=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:t,height:e,widthSegments:i,heightSegments:s};let r=t/2,o=e/2,a=Math.floor(i),c=Math.floor(s),l=a+1,h=c+1,u=t/a,f=e/c,d=[],g=[],_=[],m=[];for(let p=0;p<h;p++){let y=p*f-o;for(let b=0;b<l;b++){let v=b*u-r;g.push(v,-y,0),_.push(0,0,1),m.push(b/a),m.push(1-p/c)}}for(let p=0;p<c;p++)for(let y=0;y<a;y++){let b=y+l*p,v=y+l*(p+1),A=y+1+l*(p+1),E=y+1+l*p;d.push(b,v,E),d.push(v,A,E)}this.setIndex(d),this.setAttribute("position",new Ht(g,3)),this.setAttribute("normal",new Ht(_,3)),this.setAttribute("uv",new Ht(m,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new n(t.width,t.height,t.widthSegments,t.heightSegments)}},xs=class n extends he{constructor(t=.5,e=1,i=32,s=1,r=0,o=Math.PI*2){super(),this.type="RingGeometry",this.parameters={innerRadius:t,outerRadius:e,thetaSegments:i,phiSegments:s,thetaStart:r,thetaLength:o},i=Math.max(3,i),s=Math.max(1,s);let a=[],c=[],l=[],h=[],u=t,f=(e-t)/s,d=new N,g=new Ct;for(let _=0;_<=s;_++){for(let m=0;m<=i;m++){let p=r+m/i*o;d.x=u*Math.cos(p),d.y=u*Math.sin(p),c.push(d.x,d.y,d.z),l.push(0,0,1),g.x=(d.x/e+1)/2,g.y=(d.y/e+1)/2,h.push(g.x,g.y)}u+=f}for(let _=0;_<s;_++){let m=_*(i+1);for(let p=0;p<i;p++){let y=p+m,b=y,v=y+i+1,A=y+i+2,E=y+1;a.push(b,v,E),a.push(v,A,E)}}this.setIndex(a),this.setAttribute("position",new Ht(c,3)),this.setAttribute("normal",new Ht(l,3)),this.setAttribute("uv",new Ht(h,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new n(t.innerRadius,t.outerRadius,t.thetaSegments,t.phiSegments,t.thetaStart,t.thetaLength)}};var ys=class n extends he{constructor(t=1,e=32,i=16,s=0,r=Math.PI*2,o=0,a=Math.PI){super(),this.type="SphereGeometry",this.parameters={radius:t,widthSegments:e,heightSegments:i,phiStart:s,phiLength:r,thetaStart:o,thetaLength:a},e=Math.max(3,Math.floor(e)),i=Math.max(2,Math.floor(i));let c=Math.min(o+a,Math.PI),l=0,h=[],u=new N,f=new N,d=[],g=[],_=[],m=[];for(let p=0;p<=i;p++){let y=[],b=p/i,v=o+b*a,A=t*Math.cos(v),E=Math.sqrt(t*t-A*A),x=0;p===0&&o===0?x=.5/e:p===i&&c===Math.PI&&(x=-.5/e);for(let w=0;w<=e;w++){let D=w/e,R=s+D*r;u.x=-E*Math.cos(R),u.y=A,u.z=E*Math.sin(R),g.push(u.x,u.y,u.z),f.copy(u).normalize(),_.push(f.x,f.y,f.z),m.push(D+x,1-b),y.push(l++)}h.push(y)}for(let p=0;p<i;p++)for(let y=0;y<e;y++){let b=h[p][y+1],v=h[p][y],A=h[p+1][y],E=h[p+1][y+1];(p!==0||o>0)&&d.push(b,v,E),(p!==i-1||c<Math.PI)&&d.push(v,A,E)}this.setIndex(d),this.setAttribute("position",new Ht(g,3)),this.setAttribute("normal",new Ht(_,3)),this.setAttribute("uv",new Ht(m,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new n(t.radius,t.widthSegments,t.heightSegments,t.phiStart,t.phiLength,t.thetaStart,t.thetaLength)}};var Eo=class extends he{constructor(t=null){if(super(),this.type="WireframeGeometry",this.parameters={geometry:t},t!==null){let e=[],i=new Set,s=new N,r=new N;if(t.index!==null){let o=t.attributes.position,a=t.index,c=t.groups;c.length===0&&(c=[{start:0,count:a.count,materialIndex:0}]);for(let l=0,h=c.length;l<h;++l){let u=c[l],f=u.start,d=u.count;for(let g=f,_=f+d;g<_;g+=3)for(let m=0;m<3;m++){let p=a.getX(g+m),y=a.getX(g+(m+1)%3);s.fromBufferAttribute(o,p),r.fromBufferAttribute(o,y),Wm(s,r,i)===!0&&(e.push(s.x,s.y,s.z),e.push(r.x,r.y,r.z))}}}else{let o=t.attributes.position;for(let a=0,c=o.count/3;a<c;a++)for(let l=0;l<3;l++){let h=3*a+l,u=3*a+(l+1)%3;s.fromBufferAttribute(o,h),r.fromBufferAttribute(o,u),Wm(s,r,i)===!0&&(e.push(s.x,s.y,s.z),e.push(r.x,r.y,r.z))}}this.setAttribute("position",new Ht(e,3))}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}};function Wm(n,t,e){let i=`${n.x},${n.y},${n.z}-${t.x},${t.y},${t.z}`,s=`${t.x},${t.y},${t.z}-${n.x},${n.y},${n.z}`;return e.has(i)===!0||e.has(s)===!0?!1:(e.add(i),e.add(s),!0)}function Es(n){let t={};for(let e in n){t[e]={};for(let i in n[e]){let s=n[e][i];if(Xm(s))s.isRenderTargetTexture?(It("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),t[e][i]=null):t[e][i]=s.clone();else if(Array.isArray(s))if(Xm(s[0])){let r=[];for(let o=0,a=s.length;o<a;o++)r[o]=s[o].clone();t[e][i]=r}else t[e][i]=s.slice();else t[e][i]=s}}return t}function qe(n){let t={};for(let e=0;e<n.length;e++){let i=Es(n[e]);for(let s in i)t[s]=i[s]}return t}function Xm(n){return n&&(n.isColor||n.isMatrix3||n.isMatrix4||n.isVector2||n.isVector3||n.isVector4||n.isTexture||n.isQuaternion)}function Wv(n){let t=[];for(let e=0;e<n.length;e++)t.push(n[e].clone());return t}function pf(n){let t=n.getRenderTarget();return t===null?n.outputColorSpace:t.isXRRenderTarget===!0?t.texture.colorSpace:Yt.workingColorSpace}var Xo={clone:Es,merge:qe},Xv=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,$v=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,Mn=class extends vi{constructor(t){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=Xv,this.fragmentShader=$v,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,t!==void 0&&this.setValues(t)}copy(t){return super.copy(t),this.fragmentShader=t.fragmentShader,this.vertexShader=t.vertexShader,this.uniforms=Es(t.uniforms),this.uniformsGroups=Wv(t.uniformsGroups),this.defines=Object.assign({},t.defines),this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.fog=t.fog,this.lights=t.lights,this.clipping=t.clipping,this.extensions=Object.assign({},t.extensions),this.glslVersion=t.glslVersion,this.defaultAttributeValues=Object.assign({},t.defaultAttributeValues),this.index0AttributeName=t.index0AttributeName,this.uniformsNeedUpdate=t.uniformsNeedUpdate,this}toJSON(t){let e=super.toJSON(t);e.glslVersion=this.glslVersion,e.uniforms={};for(let s in this.uniforms){let o=this.uniforms[s].value;o&&o.isTexture?e.uniforms[s]={type:"t",value:o.toJSON(t).uuid}:o&&o.isColor?e.uniforms[s]={type:"c",value:o.getHex()}:o&&o.isVector2?e.uniforms[s]={type:"v2",value:o.toArray()}:o&&o.isVector3?e.uniforms[s]={type:"v3",value:o.toArray()}:o&&o.isVector4?e.uniforms[s]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?e.uniforms[s]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?e.uniforms[s]={type:"m4",value:o.toArray()}:e.uniforms[s]={value:o}}Object.keys(this.defines).length>0&&(e.defines=this.defines),e.vertexShader=this.vertexShader,e.fragmentShader=this.fragmentShader,e.lights=this.lights,e.clipping=this.clipping;let i={};for(let s in this.extensions)this.extensions[s]===!0&&(i[s]=!0);return Object.keys(i).length>0&&(e.extensions=i),e}fromJSON(t,e){if(super.fromJSON(t,e),t.uniforms!==void 0)for(let i in t.uniforms){let s=t.uniforms[i];switch(this.uniforms[i]={},s.type){case"t":this.uniforms[i].value=e[s.value]||null;break;case"c":this.uniforms[i].value=new zt().setHex(s.value);break;case"v2":this.uniforms[i].value=new Ct().fromArray(s.value);break;case"v3":this.uniforms[i].value=new N().fromArray(s.value);break;case"v4":this.uniforms[i].value=new ee().fromArray(s.value);break;case"m3":this.uniforms[i].value=new Ut().fromArray(s.value);break;case"m4":this.uniforms[i].value=new se().fromArray(s.value);break;default:this.uniforms[i].value=s.value}}if(t.defines!==void 0&&(this.defines=t.defines),t.vertexShader!==void 0&&(this.vertexShader=t.vertexShader),t.fragmentShader!==void 0&&(this.fragmentShader=t.fragmentShader),t.glslVersion!==void 0&&(this.glslVersion=t.glslVersion),t.extensions!==void 0)for(let i in t.extensions)this.extensions[i]=t.extensions[i];return t.lights!==void 0&&(this.lights=t.lights),t.clipping!==void 0&&(this.clipping=t.clipping),this}},Ol=class extends Mn{constructor(t){super(t),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}};var vs=class extends vi{constructor(t){super(),this.isMeshLambertMaterial=!0,this.type="MeshLambertMaterial",this.color=new zt(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new zt(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=Fc,this.normalScale=new Ct(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new yi,this.combine=Kl,this.reflectivity=1,this.envMapIntensity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.emissive.copy(t.emissive),this.emissiveMap=t.emissiveMap,this.emissiveIntensity=t.emissiveIntensity,this.bumpMap=t.bumpMap,this.bumpScale=t.bumpScale,this.normalMap=t.normalMap,this.normalMapType=t.normalMapType,this.normalScale.copy(t.normalScale),this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.envMapIntensity=t.envMapIntensity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.flatShading=t.flatShading,this.fog=t.fog,this}},Fl=class extends vi{constructor(t){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=Eg,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(t)}copy(t){return super.copy(t),this.depthPacking=t.depthPacking,this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this}},Bl=class extends vi{constructor(t){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(t)}copy(t){return super.copy(t),this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this}};function lr(n,t){return!n||n.constructor===t?n:typeof t.BYTES_PER_ELEMENT=="number"?new t(n):Array.prototype.slice.call(n)}function ul(n){return n!==void 0&&n.inTangents!==void 0&&n.outTangents!==void 0}var zi=class{constructor(t,e,i,s){this.parameterPositions=t,this._cachedIndex=0,this.resultBuffer=s!==void 0?s:new e.constructor(i),this.sampleValues=e,this.valueSize=i,this.settings=null,this.DefaultSettings_={}}evaluate(t){let e=this.parameterPositions,i=this._cachedIndex,s=e[i],r=e[i-1];t:{e:{let o;n:{i:if(!(t<s)){for(let a=i+2;;){if(s===void 0){if(t<r)break i;return i=e.length,this._cachedIndex=i,this.copySampleValue_(i-1)}if(i===a)break;if(r=s,s=e[++i],t<s)break e}o=e.length;break n}if(!(t>=r)){let a=e[1];t<a&&(i=2,r=a);for(let c=i-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(i===c)break;if(s=r,r=e[--i-1],t>=r)break e}o=i,i=0;break n}break t}for(;i<o;){let a=i+o>>>1;t<e[a]?o=a:i=a+1}if(s=e[i],r=e[i-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(s===void 0)return i=e.length,this._cachedIndex=i,this.copySampleValue_(i-1)}this._cachedIndex=i,this.intervalChanged_(i,r,s)}return this.interpolate_(i,r,t,s)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(t){let e=this.resultBuffer,i=this.sampleValues,s=this.valueSize,r=t*s;for(let o=0;o!==s;++o)e[o]=i[r+o];return e}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},kl=class extends zi{constructor(t,e,i,s){super(t,e,i,s),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:Pu,endingEnd:Pu}}intervalChanged_(t,e,i){let s=this.parameterPositions,r=t-2,o=t+1,a=s[r],c=s[o];if(a===void 0)switch(this.getSettings_().endingStart){case Iu:r=t,a=2*e-i;break;case Lu:r=s.length-2,a=e+s[r]-s[r+1];break;default:r=t,a=i}if(c===void 0)switch(this.getSettings_().endingEnd){case Iu:o=t,c=2*i-e;break;case Lu:o=1,c=i+s[1]-s[0];break;default:o=t-1,c=e}let l=(i-e)*.5,h=this.valueSize;this._weightPrev=l/(e-a),this._weightNext=l/(c-i),this._offsetPrev=r*h,this._offsetNext=o*h}interpolate_(t,e,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,c=t*a,l=c-a,h=this._offsetPrev,u=this._offsetNext,f=this._weightPrev,d=this._weightNext,g=(i-e)/(s-e),_=g*g,m=_*g,p=-f*m+2*f*_-f*g,y=(1+f)*m+(-1.5-2*f)*_+(-.5+f)*g+1,b=(-1-d)*m+(1.5+d)*_+.5*g,v=d*m-d*_;for(let A=0;A!==a;++A)r[A]=p*o[h+A]+y*o[l+A]+b*o[c+A]+v*o[u+A];return r}},zl=class extends zi{constructor(t,e,i,s){super(t,e,i,s)}interpolate_(t,e,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,c=t*a,l=c-a,h=(i-e)/(s-e),u=1-h;for(let f=0;f!==a;++f)r[f]=o[l+f]*u+o[c+f]*h;return r}},Vl=class extends zi{constructor(t,e,i,s){super(t,e,i,s)}interpolate_(t){return this.copySampleValue_(t-1)}},Gl=class extends zi{interpolate_(t,e,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,c=t*a,l=c-a,h=this.inTangents,u=this.outTangents;if(!h||!u){let g=(i-e)/(s-e),_=1-g;for(let m=0;m!==a;++m)r[m]=o[l+m]*_+o[c+m]*g;return r}let f=a*2,d=t-1;for(let g=0;g!==a;++g){let _=o[l+g],m=o[c+g],p=d*f+g*2,y=u[p],b=u[p+1],v=t*f+g*2,A=h[v],E=h[v+1],x=Yv(i,e,y,A,s);r[g]=Bg(x,_,b,E,m)}return r}};function Bg(n,t,e,i,s){let r=1-n;return r*r*r*t+3*r*r*n*e+3*r*n*n*i+n*n*n*s}function qv(n,t,e,i,s){let r=1-n;return 3*r*r*(e-t)+6*r*n*(i-e)+3*n*n*(s-i)}function Yv(n,t,e,i,s){let r=(n-t)/(s-t);for(let o=0;o<8;o++){let a=Bg(r,t,e,i,s)-n;if(Math.abs(a)<1e-10)break;let c=qv(r,t,e,i,s);if(Math.abs(c)<1e-10)break;r=Math.max(0,Math.min(1,r-a/c))}return r}var pn=class{constructor(t,e,i,s){if(t===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(e===void 0||e.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+t);this.name=t,this.times=lr(e,this.TimeBufferType),this.values=lr(i,this.ValueBufferType),this.setInterpolation(s||this.DefaultInterpolation)}static toJSON(t){let e=t.constructor,i;if(e.toJSON!==this.toJSON)i=e.toJSON(t);else{i={name:t.name,times:lr(t.times,Array),values:lr(t.values,Array)};let s=t.getInterpolation();s!==t.DefaultInterpolation&&(i.interpolation=s),ul(t.settings)&&(i.settings={inTangents:lr(t.settings.inTangents,Array),outTangents:lr(t.settings.outTangents,Array)})}return i.type=t.ValueTypeName,i}InterpolantFactoryMethodDiscrete(t){return new Vl(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodLinear(t){return new zl(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodSmooth(t){return new kl(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodBezier(t){let e=new Gl(this.times,this.values,this.getValueSize(),t);return this.settings&&(e.inTangents=this.settings.inTangents,e.outTangents=this.settings.outTangents),e}setInterpolation(t){let e;switch(t){case co:e=this.InterpolantFactoryMethodDiscrete;break;case Al:e=this.InterpolantFactoryMethodLinear;break;case ml:e=this.InterpolantFactoryMethodSmooth;break;case Ru:e=this.InterpolantFactoryMethodBezier;break}if(e===void 0){let i="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(t!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(i);return It("KeyframeTrack:",i),this}return this.createInterpolant=e,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return co;case this.InterpolantFactoryMethodLinear:return Al;case this.InterpolantFactoryMethodSmooth:return ml;case this.InterpolantFactoryMethodBezier:return Ru}}getValueSize(){return this.values.length/this.times.length}shift(t){if(t!==0){let e=this.times;for(let i=0,s=e.length;i!==s;++i)e[i]+=t;ul(this.settings)&&($m(this.settings.inTangents,t),$m(this.settings.outTangents,t))}return this}scale(t){if(t!==1){let e=this.times;for(let i=0,s=e.length;i!==s;++i)e[i]*=t;ul(this.settings)&&(qm(this.settings.inTangents,t),qm(this.settings.outTangents,t))}return this}trim(t,e){let i=this.times,s=i.length,r=0,o=s-1;for(;r!==s&&i[r]<t;)++r;for(;o!==-1&&i[o]>e;)--o;if(++o,r!==0||o!==s){r>=o&&(o=Math.max(o,1),r=o-1);let a=this.getValueSize();this.times=i.slice(r,o),this.values=this.values.slice(r*a,o*a)}return this}validate(){let t=!0,e=this.getValueSize();e-Math.floor(e)!==0&&(Nt("KeyframeTrack: Invalid value size in track.",this),t=!1);let i=this.times,s=this.values,r=i.length;r===0&&(Nt("KeyframeTrack: Track is empty.",this),t=!1);let o=null;for(let a=0;a!==r;a++){let c=i[a];if(typeof c=="number"&&isNaN(c)){Nt("KeyframeTrack: Time is not a valid number.",this,a,c),t=!1;break}if(o!==null&&o>c){Nt("KeyframeTrack: Out of order keys.",this,a,c,o),t=!1;break}o=c}if(s!==void 0&&hv(s))for(let a=0,c=s.length;a!==c;++a){let l=s[a];if(isNaN(l)){Nt("KeyframeTrack: Value is not a valid number.",this,a,l),t=!1;break}}return t}optimize(){let t=this.times.slice(),e=this.values.slice(),i=this.getValueSize(),s=this.getInterpolation()===ml,r=t.length-1,o=1;for(let a=1;a<r;++a){let c=!1,l=t[a],h=t[a+1];if(l!==h&&(a!==1||l!==t[0]))if(s)c=!0;else{let u=a*i,f=u-i,d=u+i;for(let g=0;g!==i;++g){let _=e[u+g];if(_!==e[f+g]||_!==e[d+g]){c=!0;break}}}if(c){if(a!==o){t[o]=t[a];let u=a*i,f=o*i;for(let d=0;d!==i;++d)e[f+d]=e[u+d]}++o}}if(r>0){t[o]=t[r];for(let a=r*i,c=o*i,l=0;l!==i;++l)e[c+l]=e[a+l];++o}return o!==t.length?(this.times=t.slice(0,o),this.values=e.slice(0,o*i)):(this.times=t,this.values=e),this}clone(){let t=this.times.slice(),e=this.values.slice(),i=this.constructor,s=new i(this.name,t,e);return s.createInterpolant=this.createInterpolant,ul(this.settings)&&(s.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),s}};function $m(n,t){for(let e=0,i=n.length;e!==i;e+=2)n[e]+=t}function qm(n,t){for(let e=0,i=n.length;e!==i;e+=2)n[e]*=t}pn.prototype.ValueTypeName="";pn.prototype.TimeBufferType=Float32Array;pn.prototype.ValueBufferType=Float32Array;pn.prototype.DefaultInterpolation=Al;var Vi=class extends pn{constructor(t,e,i){super(t,e,i)}};Vi.prototype.ValueTypeName="bool";Vi.prototype.ValueBufferType=Array;Vi.prototype.DefaultInterpolation=co;Vi.prototype.InterpolantFactoryMethodLinear=void 0;Vi.prototype.InterpolantFactoryMethodSmooth=void 0;var Hl=class extends pn{constructor(t,e,i,s){super(t,e,i,s)}};Hl.prototype.ValueTypeName="color";var Wl=class extends pn{constructor(t,e,i,s){super(t,e,i,s)}};Wl.prototype.ValueTypeName="number";var Xl=class extends zi{constructor(t,e,i,s){super(t,e,i,s)}interpolate_(t,e,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,c=(i-e)/(s-e),l=t*a;for(let h=l+a;l!==h;l+=4)Ne.slerpFlat(r,0,o,l-a,o,l,c);return r}},Ao=class extends pn{constructor(t,e,i,s){super(t,e,i,s)}InterpolantFactoryMethodLinear(t){return new Xl(this.times,this.values,this.getValueSize(),t)}};Ao.prototype.ValueTypeName="quaternion";Ao.prototype.InterpolantFactoryMethodSmooth=void 0;var Gi=class extends pn{constructor(t,e,i){super(t,e,i)}};Gi.prototype.ValueTypeName="string";Gi.prototype.ValueBufferType=Array;Gi.prototype.DefaultInterpolation=co;Gi.prototype.InterpolantFactoryMethodLinear=void 0;Gi.prototype.InterpolantFactoryMethodSmooth=void 0;var $l=class extends pn{constructor(t,e,i,s){super(t,e,i,s)}};$l.prototype.ValueTypeName="vector";var ql=class{constructor(t,e,i){let s=this,r=!1,o=0,a=0,c,l=[];this.onStart=void 0,this.onLoad=t,this.onProgress=e,this.onError=i,this._abortController=null,this.itemStart=function(h){a++,r===!1&&s.onStart!==void 0&&s.onStart(h,o,a),r=!0},this.itemEnd=function(h){o++,s.onProgress!==void 0&&s.onProgress(h,o,a),o===a&&(r=!1,s.onLoad!==void 0&&s.onLoad())},this.itemError=function(h){s.onError!==void 0&&s.onError(h)},this.resolveURL=function(h){return h=h.normalize("NFC"),c?c(h):h},this.setURLModifier=function(h){return c=h,this},this.addHandler=function(h,u){return l.push(h,u),this},this.removeHandler=function(h){let u=l.indexOf(h);return u!==-1&&l.splice(u,2),this},this.getHandler=function(h){for(let u=0,f=l.length;u<f;u+=2){let d=l[u],g=l[u+1];if(d.global&&(d.lastIndex=0),d.test(h))return g}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},kg=new ql,Yl=class{constructor(t){this.manager=t!==void 0?t:kg,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(t,e){let i=this;return new Promise(function(s,r){i.load(t,s,e,r)})}parse(){}setCrossOrigin(t){return this.crossOrigin=t,this}setWithCredentials(t){return this.withCredentials=t,this}setPath(t){return this.path=t,this}setResourcePath(t){return this.resourcePath=t,this}setRequestHeader(t){return this.requestHeader=t,this}setPriority(t){return this.priority=t,this}setCache(t){return this.cache=t,this}abort(){return this}};Yl.DEFAULT_MATERIAL_NAME="__DEFAULT";var To=class extends $e{static registerNode(t){this.prototype._lightNode=t}constructor(t,e=1){super(),this.isLight=!0,this.type="Light",this.color=new zt(t),this.intensity=e}copy(t,e){return super.copy(t,e),this.color.copy(t.color),this.intensity=t.intensity,this}toJSON(t){let e=super.toJSON(t);return e.object.color=this.color.getHex(),e.object.intensity=this.intensity,e}};var Tu=new se,Ym=new N,Zm=new N,Zl=class{constructor(t){this.camera=t,this.intensity=1,this.bias=0,this.biasNode=null,this.normalBias=0,this.radius=1,this.blurSamples=8,this.mapSize=new Ct(512,512),this.mapType=an,this.map=null,this.mapPass=null,this.matrix=new se,this.autoUpdate=!0,this.needsUpdate=!1,this._frustum=new Bi,this._frameExtents=new Ct(1,1),this._viewportCount=1,this._viewports=[new ee(0,0,1,1)]}getViewportCount(){return this._viewportCount}getCamera(){return this.camera}getFrustum(){return this._frustum}updateMatrices(t){let e=this.camera;Ym.setFromMatrixPosition(t.matrixWorld),e.position.copy(Ym),Zm.setFromMatrixPosition(t.target.matrixWorld),e.lookAt(Zm),e.updateMatrixWorld(),this._updateMatrix(e,this.matrix,this._frustum)}_updateMatrix(t,e,i,s){Tu.multiplyMatrices(t.projectionMatrix,t.matrixWorldInverse),i.setFromProjectionMatrix(Tu,t.coordinateSystem,t.reversedDepth);let r=this._frameExtents,o=s?s.z/r.x:1,a=s?s.w/r.y:1,c=s?s.x/r.x:0,l=s?s.y/r.y:0;t.coordinateSystem===gr||t.reversedDepth?e.set(.5*o,0,0,.5*o+c,0,.5*a,0,.5*a+l,0,0,1,0,0,0,0,1):e.set(.5*o,0,0,.5*o+c,0,.5*a,0,.5*a+l,0,0,.5,.5,0,0,0,1),e.multiply(Tu)}getViewport(t){return this._viewports[t]}getFrameExtents(){return this._frameExtents}dispose(){this.map&&this.map.dispose(),this.mapPass&&this.mapPass.dispose()}copy(t){return this.camera=t.camera.clone(),this.intensity=t.intensity,this.bias=t.bias,this.radius=t.radius,this.autoUpdate=t.autoUpdate,this.needsUpdate=t.needsUpdate,this.normalBias=t.normalBias,this.blurSamples=t.blurSamples,this.mapSize.copy(t.mapSize),this.mapType=t.mapType,this.biasNode=t.biasNode,this}clone(){return new this.constructor().copy(this)}toJSON(){let t={};return t.intensity=this.intensity,t.bias=this.bias,t.normalBias=this.normalBias,t.radius=this.radius,t.blurSamples=this.blurSamples,t.mapSize=this.mapSize.toArray(),t.mapType=this.mapType,t.camera=this.camera.toJSON(!1).object,delete t.camera.matrix,t}},fl=new N,dl=new Ne,$n=new N,Co=class extends $e{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new se,this.projectionMatrix=new se,this.projectionMatrixInverse=new se,this.coordinateSystem=bn,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(t,e){return super.copy(t,e),this.matrixWorldInverse.copy(t.matrixWorldInverse),this.projectionMatrix.copy(t.projectionMatrix),this.projectionMatrixInverse.copy(t.projectionMatrixInverse),this.coordinateSystem=t.coordinateSystem,this}getWorldDirection(t){return super.getWorldDirection(t).negate()}updateMatrixWorld(t){super.updateMatrixWorld(t),this.matrixWorld.decompose(fl,dl,$n),$n.x===1&&$n.y===1&&$n.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(fl,dl,$n.set(1,1,1)).invert()}updateWorldMatrix(t,e,i=!1){super.updateWorldMatrix(t,e,i),this.matrixWorld.decompose(fl,dl,$n),$n.x===1&&$n.y===1&&$n.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(fl,dl,$n.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},Oi=new N,Jm=new Ct,Km=new Ct,je=class extends Co{constructor(t=50,e=1,i=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=t,this.zoom=1,this.near=i,this.far=s,this.focus=10,this.aspect=e,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.fov=t.fov,this.zoom=t.zoom,this.near=t.near,this.far=t.far,this.focus=t.focus,this.aspect=t.aspect,this.view=t.view===null?null:Object.assign({},t.view),this.filmGauge=t.filmGauge,this.filmOffset=t.filmOffset,this}setFocalLength(t){let e=.5*this.getFilmHeight()/t;this.fov=xr*2*Math.atan(e),this.updateProjectionMatrix()}getFocalLength(){let t=Math.tan(dr*.5*this.fov);return .5*this.getFilmHeight()/t}getEffectiveFOV(){return xr*2*Math.atan(Math.tan(dr*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(t,e,i){Oi.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),e.set(Oi.x,Oi.y).multiplyScalar(-t/Oi.z),Oi.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),i.set(Oi.x,Oi.y).multiplyScalar(-t/Oi.z)}getViewSize(t,e){return this.getViewBounds(t,Jm,Km),e.subVectors(Km,Jm)}setViewOffset(t,e,i,s,r,o){this.aspect=t/e,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=i,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=this.near,e=t*Math.tan(dr*.5*this.fov)/this.zoom,i=2*e,s=this.aspect*i,r=-.5*s,o=this.view;if(this.view!==null&&this.view.enabled){let c=o.fullWidth,l=o.fullHeight;r+=o.offsetX*s/c,e-=o.offsetY*i/l,s*=o.width/c,i*=o.height/l}let a=this.filmOffset;a!==0&&(r+=t*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,e,e-i,t,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.fov=this.fov,e.object.zoom=this.zoom,e.object.near=this.near,e.object.far=this.far,e.object.focus=this.focus,e.object.aspect=this.aspect,this.view!==null&&(e.object.view=Object.assign({},this.view)),e.object.filmGauge=this.filmGauge,e.object.filmOffset=this.filmOffset,e}};var Ro=class extends Co{constructor(t=-1,e=1,i=1,s=-1,r=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=t,this.right=e,this.top=i,this.bottom=s,this.near=r,this.far=o,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.left=t.left,this.right=t.right,this.top=t.top,this.bottom=t.bottom,this.near=t.near,this.far=t.far,this.zoom=t.zoom,this.view=t.view===null?null:Object.assign({},t.view),this}setViewOffset(t,e,i,s,r,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=i,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=(this.right-this.left)/(2*this.zoom),e=(this.top-this.bottom)/(2*this.zoom),i=(this.right+this.left)/2,s=(this.top+this.bottom)/2,r=i-t,o=i+t,a=s+e,c=s-e;if(this.view!==null&&this.view.enabled){let l=(this.right-this.left)/this.view.fullWidth/this.zoom,h=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=l*this.view.offsetX,o=r+l*this.view.width,a-=h*this.view.offsetY,c=a-h*this.view.height}this.projectionMatrix.makeOrthographic(r,o,a,c,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.zoom=this.zoom,e.object.left=this.left,e.object.right=this.right,e.object.top=this.top,e.object.bottom=this.bottom,e.object.near=this.near,e.object.far=this.far,this.view!==null&&(e.object.view=Object.assign({},this.view)),e}},Nu=class extends Zl{constructor(){super(new Ro(-5,5,5,-5,.5,500)),this.isDirectionalLightShadow=!0}},Po=class extends To{constructor(t,e){super(t,e),this.isDirectionalLight=!0,this.type="DirectionalLight",this.position.copy($e.DEFAULT_UP),this.updateMatrix(),this.target=new $e,this.shadow=new Nu}dispose(){super.dispose(),this.shadow.dispose()}copy(t){return super.copy(t),this.target=t.target.clone(),this.shadow=t.shadow.clone(),this}toJSON(t){let e=super.toJSON(t);return e.object.shadow=this.shadow.toJSON(),e.object.target=this.target.uuid,e}},Io=class extends To{constructor(t,e){super(t,e),this.isAmbientLight=!0,this.type="AmbientLight"}};var Lo=class extends he{constructor(){super(),this.isInstancedBufferGeometry=!0,this.type="InstancedBufferGeometry",this.instanceCount=1/0}copy(t){return super.copy(t),this.instanceCount=t.instanceCount,this}toJSON(){let t=super.toJSON();return t.instanceCount=this.instanceCount,t.isInstancedBufferGeometry=!0,t}};var cr=-90,hr=1,Sr=class extends $e{constructor(t,e,i){super(),this.type="CubeCamera",this.renderTarget=i,this.coordinateSystem=null,this.activeMipmapLevel=0;let s=new je(cr,hr,t,e);s.layers=this.layers,this.add(s);let r=new je(cr,hr,t,e);r.layers=this.layers,this.add(r);let o=new je(cr,hr,t,e);o.layers=this.layers,this.add(o);let a=new je(cr,hr,t,e);a.layers=this.layers,this.add(a);let c=new je(cr,hr,t,e);c.layers=this.layers,this.add(c);let l=new je(cr,hr,t,e);l.layers=this.layers,this.add(l)}updateCoordinateSystem(){let t=this.coordinateSystem,e=this.children.concat(),[i,s,r,o,a,c]=e;for(let l of e)this.remove(l);if(t===bn)i.up.set(0,1,0),i.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),c.up.set(0,1,0),c.lookAt(0,0,-1);else if(t===gr)i.up.set(0,-1,0),i.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),c.up.set(0,-1,0),c.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+t);for(let l of e)this.add(l),l.updateMatrixWorld()}update(t,e){this.parent===null&&this.updateMatrixWorld();let{renderTarget:i,activeMipmapLevel:s}=this;this.coordinateSystem!==t.coordinateSystem&&(this.coordinateSystem=t.coordinateSystem,this.updateCoordinateSystem());let[r,o,a,c,l,h]=this.children,u=t.getRenderTarget(),f=t.getActiveCubeFace(),d=t.getActiveMipmapLevel(),g=t.xr.enabled;t.xr.enabled=!1;let _=i.texture.mipmapsAutoUpdate;i.texture.mipmapsAutoUpdate=!1;let m=!1;t.isWebGLRenderer===!0?m=t.state.buffers.depth.getReversed():m=t.reversedDepthBuffer,t.setRenderTarget(i,0,s),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,r),t.setRenderTarget(i,1,s),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,o),t.setRenderTarget(i,2,s),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,a),t.setRenderTarget(i,3,s),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,c),t.setRenderTarget(i,4,s),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,l),i.texture.mipmapsAutoUpdate=_,t.setRenderTarget(i,5,s),m&&t.autoClear===!1&&t.clearDepth(),t.render(e,h),t.setRenderTarget(u,f,d),t.xr.enabled=g,i.texture.needsPMREMUpdate=!0}},Jl=class extends je{constructor(t=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=t,this.perCameraFrustumCulled=!1}};var mf="\\[\\]\\.:\\/",Zv=new RegExp("["+mf+"]","g"),gf="[^"+mf+"]",Jv="[^"+mf.replace("\\.","")+"]",Kv=/((?:WC+[\/:])*)/.source.replace("WC",gf),jv=/(WCOD+)?/.source.replace("WCOD",Jv),Qv=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",gf),tb=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",gf),eb=new RegExp("^"+Kv+jv+Qv+tb+"$"),nb=["material","materials","bones","map"],Du=class{constructor(t,e,i){let s=i||ce.parseTrackName(e);this._targetGroup=t,this._bindings=t.subscribe_(e,s)}getValue(t,e){this.bind();let i=this._targetGroup.nCachedObjects_,s=this._bindings[i];s!==void 0&&s.getValue(t,e)}setValue(t,e){let i=this._bindings;for(let s=this._targetGroup.nCachedObjects_,r=i.length;s!==r;++s)i[s].setValue(t,e)}bind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,i=t.length;e!==i;++e)t[e].bind()}unbind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,i=t.length;e!==i;++e)t[e].unbind()}},ce=class n{constructor(t,e,i){this.path=e,this.parsedPath=i||n.parseTrackName(e),this.node=n.findNode(t,this.parsedPath.nodeName),this.rootNode=t,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(t,e,i){return t&&t.isAnimationObjectGroup?new n.Composite(t,e,i):new n(t,e,i)}static sanitizeNodeName(t){return t.replace(/\s/g,"_").replace(Zv,"")}static parseTrackName(t){let e=eb.exec(t);if(e===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+t);let i={nodeName:e[2],objectName:e[3],objectIndex:e[4],propertyName:e[5],propertyIndex:e[6]},s=i.nodeName&&i.nodeName.lastIndexOf(".");if(s!==void 0&&s!==-1){let r=i.nodeName.substring(s+1);nb.indexOf(r)!==-1&&(i.nodeName=i.nodeName.substring(0,s),i.objectName=r)}if(i.propertyName===null||i.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+t);return i}static findNode(t,e){if(e===void 0||e===""||e==="."||e===-1||e===t.name||e===t.uuid)return t;if(t.skeleton){let i=t.skeleton.getBoneByName(e);if(i!==void 0)return i}if(t.children){let i=function(r){for(let o=0;o<r.length;o++){let a=r[o];if(a.name===e||a.uuid===e)return a;let c=i(a.children);if(c)return c}return null},s=i(t.children);if(s)return s}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(t,e){t[e]=this.targetObject[this.propertyName]}_getValue_array(t,e){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)t[e++]=i[s]}_getValue_arrayElement(t,e){t[e]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(t,e){this.resolvedProperty.toArray(t,e)}_setValue_direct(t,e){this.targetObject[this.propertyName]=t[e]}_setValue_direct_setNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(t,e){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=t[e++]}_setValue_array_setNeedsUpdate(t,e){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=t[e++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(t,e){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=t[e++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(t,e){this.resolvedProperty[this.propertyIndex]=t[e]}_setValue_arrayElement_setNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(t,e){this.resolvedProperty.fromArray(t,e)}_setValue_fromArray_setNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(t,e){this.bind(),this.getValue(t,e)}_setValue_unbound(t,e){this.bind(),this.setValue(t,e)}bind(){let t=this.node,e=this.parsedPath,i=e.objectName,s=e.propertyName,r=e.propertyIndex;if(t||(t=n.findNode(this.rootNode,e.nodeName),this.node=t),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!t){It("PropertyBinding: No target node found for track: "+this.path+".");return}if(i){let l=e.objectIndex;switch(i){case"materials":if(!t.material){Nt("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.materials){Nt("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}t=t.material.materials;break;case"bones":if(!t.skeleton){Nt("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}t=t.skeleton.bones;for(let h=0;h<t.length;h++)if(t[h].name===l){l=h;break}break;case"map":if("map"in t){t=t.map;break}if(!t.material){Nt("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.map){Nt("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}t=t.material.map;break;default:if(t[i]===void 0){Nt("PropertyBinding: Can not bind to objectName of node undefined.",this);return}t=t[i]}if(l!==void 0){if(t[l]===void 0){Nt("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,t);return}t=t[l]}}let o=t[s];if(o===void 0){let l=e.nodeName;Nt("PropertyBinding: Trying to update property for track: "+l+"."+s+" but it wasn't found.",t);return}let a=this.Versioning.None;this.targetObject=t,t.isMaterial===!0?a=this.Versioning.NeedsUpdate:t.isObject3D===!0&&(a=this.Versioning.MatrixWorldNeedsUpdate);let c=this.BindingType.Direct;if(r!==void 0){if(s==="morphTargetInfluences"){if(!t.geometry){Nt("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!t.geometry.morphAttributes){Nt("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}t.morphTargetDictionary[r]!==void 0&&(r=t.morphTargetDictionary[r])}c=this.BindingType.ArrayElement,this.resolvedProperty=o,this.propertyIndex=r}else o.fromArray!==void 0&&o.toArray!==void 0?(c=this.BindingType.HasFromToArray,this.resolvedProperty=o):Array.isArray(o)?(c=this.BindingType.EntireArray,this.resolvedProperty=o):this.propertyName=s;this.getValue=this.GetterByBindingType[c],this.setValue=this.SetterByBindingTypeAndVersioning[c][a]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};ce.Composite=Du;ce.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};ce.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};ce.prototype.GetterByBindingType=[ce.prototype._getValue_direct,ce.prototype._getValue_array,ce.prototype._getValue_arrayElement,ce.prototype._getValue_toArray];ce.prototype.SetterByBindingTypeAndVersioning=[[ce.prototype._setValue_direct,ce.prototype._setValue_direct_setNeedsUpdate,ce.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[ce.prototype._setValue_array,ce.prototype._setValue_array_setNeedsUpdate,ce.prototype._setValue_array_setMatrixWorldNeedsUpdate],[ce.prototype._setValue_arrayElement,ce.prototype._setValue_arrayElement_setNeedsUpdate,ce.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[ce.prototype._setValue_fromArray,ce.prototype._setValue_fromArray_setNeedsUpdate,ce.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var tR=new Float32Array(1);var Hi=class extends Pl{constructor(t,e,i=1){super(t,e),this.isInstancedInterleavedBuffer=!0,this.meshPerAttribute=i}copy(t){return super.copy(t),this.meshPerAttribute=t.meshPerAttribute,this}clone(t){let e=super.clone(t);return e.meshPerAttribute=this.meshPerAttribute,e}toJSON(t){let e=super.toJSON(t);return e.isInstancedInterleavedBuffer=!0,e.meshPerAttribute=this.meshPerAttribute,e}};var jm=new se,No=class{constructor(t,e,i=0,s=1/0){this.ray=new Fi(t,e),this.near=i,this.far=s,this.camera=null,this.layers=new vr,this.params={Mesh:{},Line:{threshold:1},LOD:{},Points:{threshold:1},Sprite:{}}}set(t,e){this.ray.set(t,e)}setFromCamera(t,e){e.isPerspectiveCamera?(this.ray.origin.setFromMatrixPosition(e.matrixWorld),this.ray.direction.set(t.x,t.y,.5).unproject(e).sub(this.ray.origin).normalize(),this.camera=e):e.isOrthographicCamera?(this.ray.origin.set(t.x,t.y,e.projectionMatrix.elements[14]).unproject(e),this.ray.direction.set(0,0,-1).transformDirection(e.matrixWorld),this.camera=e):Nt("Raycaster: Unsupported camera type: "+e.type)}setFromXRController(t){return jm.identity().extractRotation(t.matrixWorld),this.ray.origin.setFromMatrixPosition(t.matrixWorld),this.ray.direction.set(0,0,-1).applyMatrix4(jm),this}intersectObject(t,e=!0,i=[]){return Uu(t,this,i,e),i.sort(Qm),i}intersectObjects(t,e=!0,i=[]){for(let s=0,r=t.length;s<r;s++)Uu(t[s],this,i,e);return i.sort(Qm),i}};function Qm(n,t){return n.distance-t.distance}function Uu(n,t,e,i){let s=!0;if(n.layers.test(t.layers)&&n.raycast(t,e)===!1&&(s=!1),s===!0&&i===!0){let r=n.children;for(let o=0,a=r.length;o<a;o++)Uu(r[o],t,e,!0)}}var wr=class{constructor(t=1,e=0,i=0){this.radius=t,this.phi=e,this.theta=i}set(t,e,i){return this.radius=t,this.phi=e,this.theta=i,this}copy(t){return this.radius=t.radius,this.phi=t.phi,this.theta=t.theta,this}makeSafe(){return this.phi=Bt(this.phi,1e-6,Math.PI-1e-6),this}setFromVector3(t){return this.setFromCartesianCoords(t.x,t.y,t.z)}setFromCartesianCoords(t,e,i){return this.radius=Math.sqrt(t*t+e*e+i*i),this.radius===0?(this.theta=0,this.phi=0):(this.theta=Math.atan2(t,i),this.phi=Math.acos(Bt(e/this.radius,-1,1))),this}clone(){return new this.constructor().copy(this)}};var Ou=class{static{this.prototype.isMatrix2=!0}constructor(t,e,i,s){this.elements=[1,0,0,1],t!==void 0&&this.set(t,e,i,s)}identity(){return this.set(1,0,0,1),this}fromArray(t,e=0){for(let i=0;i<4;i++)this.elements[i]=t[i+e];return this}set(t,e,i,s){let r=this.elements;return r[0]=t,r[2]=e,r[1]=i,r[3]=s,this}};var tg=new N,pl=new N,ur=new N,fr=new N,Cu=new N,ib=new N,sb=new N,Do=class{constructor(t=new N,e=new N){this.start=t,this.end=e}set(t,e){return this.start.copy(t),this.end.copy(e),this}copy(t){return this.start.copy(t.start),this.end.copy(t.end),this}getCenter(t){return t.addVectors(this.start,this.end).multiplyScalar(.5)}delta(t){return t.subVectors(this.end,this.start)}distanceSq(){return this.start.distanceToSquared(this.end)}distance(){return this.start.distanceTo(this.end)}at(t,e){return this.delta(e).multiplyScalar(t).add(this.start)}closestPointToPointParameter(t,e){tg.subVectors(t,this.start),pl.subVectors(this.end,this.start);let i=pl.dot(pl);if(i===0)return 0;let r=pl.dot(tg)/i;return e&&(r=Bt(r,0,1)),r}closestPointToPoint(t,e,i){let s=this.closestPointToPointParameter(t,e);return this.delta(i).multiplyScalar(s).add(this.start)}distanceSqToLine3(t,e=ib,i=sb){let s=10000000000000001e-32,r,o,a=this.start,c=t.start,l=this.end,h=t.end;ur.subVectors(l,a),fr.subVectors(h,c),Cu.subVectors(a,c);let u=ur.dot(ur),f=fr.dot(fr),d=fr.dot(Cu);if(u<=s&&f<=s)return e.copy(a),i.copy(c),e.distanceToSquared(i);if(u<=s)r=0,o=d/f,o=Bt(o,0,1);else{let g=ur.dot(Cu);if(f<=s)o=0,r=Bt(-g/u,0,1);else{let _=ur.dot(fr),m=u*f-_*_;m!==0?r=Bt((_*d-g*f)/m,0,1):r=0,o=(_*r+d)/f,o<0?(o=0,r=Bt(-g/u,0,1)):o>1&&(o=1,r=Bt((_-g)/u,0,1))}}return e.copy(a).addScaledVector(ur,r),i.copy(c).addScaledVector(fr,o),e.distanceToSquared(i)}applyMatrix4(t){return this.start.applyMatrix4(t),this.end.applyMatrix4(t),this}equals(t){return t.start.equals(this.start)&&t.end.equals(this.end)}clone(){return new this.constructor().copy(this)}};var Uo=class extends Nn{constructor(t,e=null){super(),this.object=t,this.domElement=e,this.enabled=!0,this.state=-1,this.keys={},this.mouseButtons={LEFT:null,MIDDLE:null,RIGHT:null},this.touches={ONE:null,TWO:null}}connect(t){this.domElement!==null&&this.disconnect(),this.domElement=t}disconnect(){}dispose(){}update(){}};function _f(n,t,e,i){let s=rb(i);switch(e){case ef:return n*t;case sf:return n*t/s.components*s.byteLength;case sc:return n*t/s.components*s.byteLength;case qi:return n*t*2/s.components*s.byteLength;case rc:return n*t*2/s.components*s.byteLength;case nf:return n*t*3/s.components*s.byteLength;case zn:return n*t*4/s.components*s.byteLength;case oc:return n*t*4/s.components*s.byteLength;case Bo:case ko:return Math.floor((n+3)/4)*Math.floor((t+3)/4)*8;case zo:case Vo:return Math.floor((n+3)/4)*Math.floor((t+3)/4)*16;case lc:case hc:return Math.max(n,16)*Math.max(t,8)/4;case ac:case cc:return Math.max(n,8)*Math.max(t,8)/2;case uc:case fc:case pc:case mc:return Math.floor((n+3)/4)*Math.floor((t+3)/4)*8;case dc:case Go:case gc:return Math.floor((n+3)/4)*Math.floor((t+3)/4)*16;case _c:return Math.floor((n+3)/4)*Math.floor((t+3)/4)*16;case xc:return Math.floor((n+4)/5)*Math.floor((t+3)/4)*16;case yc:return Math.floor((n+4)/5)*Math.floor((t+4)/5)*16;case vc:return Math.floor((n+5)/6)*Math.floor((t+4)/5)*16;case bc:return Math.floor((n+5)/6)*Math.floor((t+5)/6)*16;case Mc:return Math.floor((n+7)/8)*Math.floor((t+4)/5)*16;case Sc:return Math.floor((n+7)/8)*Math.floor((t+5)/6)*16;case wc:return Math.floor((n+7)/8)*Math.floor((t+7)/8)*16;case Ec:return Math.floor((n+9)/10)*Math.floor((t+4)/5)*16;case Ac:return Math.floor((n+9)/10)*Math.floor((t+5)/6)*16;case Tc:return Math.floor((n+9)/10)*Math.floor((t+7)/8)*16;case Cc:return Math.floor((n+9)/10)*Math.floor((t+9)/10)*16;case Rc:return Math.floor((n+11)/12)*Math.floor((t+9)/10)*16;case Pc:return Math.floor((n+11)/12)*Math.floor((t+11)/12)*16;case Ic:case Lc:case Nc:return Math.ceil(n/4)*Math.ceil(t/4)*16;case Dc:case Uc:return Math.ceil(n/4)*Math.ceil(t/4)*8;case Ho:case Oc:return Math.ceil(n/4)*Math.ceil(t/4)*16}throw new Error(`Unable to determine texture byte length for ${e} format.`)}function rb(n){switch(n){case an:case Ku:return{byteLength:1,components:1};case Cr:case ju:case kn:return{byteLength:2,components:1};case nc:case ic:return{byteLength:2,components:4};case Fn:case ec:case Bn:return{byteLength:4,components:1};case Qu:case tf:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${n}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?It("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");function a0(){let n=null,t=!1,e=null,i=null;function s(r,o){i=n.requestAnimationFrame(s),e(r,o)}return{start:function(){t!==!0&&e!==null&&n!==null&&(i=n.requestAnimationFrame(s),t=!0)},stop:function(){n!==null&&n.cancelAnimationFrame(i),t=!1},setAnimationLoop:function(r){e=r},setContext:function(r){n=r}}}function ab(n){let t=new WeakMap;function e(a,c){let l=a.array,h=a.usage,u=l.byteLength,f=n.createBuffer();n.bindBuffer(c,f),n.bufferData(c,l,h),a.onUploadCallback();let d;if(l instanceof Float32Array)d=n.FLOAT;else if(typeof Float16Array<"u"&&l instanceof Float16Array)d=n.HALF_FLOAT;else if(l instanceof Uint16Array)a.isFloat16BufferAttribute?d=n.HALF_FLOAT:d=n.UNSIGNED_SHORT;else if(l instanceof Int16Array)d=n.SHORT;else if(l instanceof Uint32Array)d=n.UNSIGNED_INT;else if(l instanceof Int32Array)d=n.INT;else if(l instanceof Int8Array)d=n.BYTE;else if(l instanceof Uint8Array)d=n.UNSIGNED_BYTE;else if(l instanceof Uint8ClampedArray)d=n.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+l);return{buffer:f,type:d,bytesPerElement:l.BYTES_PER_ELEMENT,version:a.version,size:u}}function i(a,c,l){let h=c.array,u=c.updateRanges;if(n.bindBuffer(l,a),u.length===0)n.bufferSubData(l,0,h);else{u.sort((d,g)=>d.start-g.start);let f=0;for(let d=1;d<u.length;d++){let g=u[f],_=u[d];_.start<=g.start+g.count+1?g.count=Math.max(g.count,_.start+_.count-g.start):(++f,u[f]=_)}u.length=f+1;for(let d=0,g=u.length;d<g;d++){let _=u[d];n.bufferSubData(l,_.start*h.BYTES_PER_ELEMENT,h,_.start,_.count)}c.clearUpdateRanges()}c.onUploadCallback()}function s(a){return a.isInterleavedBufferAttribute&&(a=a.data),t.get(a)}function r(a){a.isInterleavedBufferAttribute&&(a=a.data);let c=t.get(a);c&&(n.deleteBuffer(c.buffer),t.delete(a))}function o(a,c){if(a.isInterleavedBufferAttribute&&(a=a.data),a.isGLBufferAttribute){let h=t.get(a);(!h||h.version<a.version)&&t.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}let l=t.get(a);if(l===void 0)t.set(a,e(a,c));else if(l.version<a.version){if(l.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");i(l.buffer,a,c),l.version=a.version}}return{get:s,remove:r,update:o}}var lb=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,cb=`#ifdef USE_ALPHAHASH
	const float ALPHA_HASH_SCALE = 0.05;
	float hash2D( vec2 value ) {
		return fract( 1.0e4 * sin( 17.0 * value.x + 0.1 * value.y ) * ( 0.1 + abs( sin( 13.0 * value.y + value.x ) ) ) );
	}
	float hash3D( vec3 value ) {
		return hash2D( vec2( hash2D( value.xy ), value.z ) );
	}
	float getAlphaHashThreshold( vec3 position ) {
		float maxDeriv = max(
			length( dFdx( position.xyz ) ),
			length( dFdy( position.xyz ) )
		);
		float pixScale = 1.0 / ( ALPHA_HASH_SCALE * maxDeriv );
		vec2 pixScales = vec2(
			exp2( floor( log2( pixScale ) ) ),
			exp2( ceil( log2( pixScale ) ) )
		);
		vec2 alpha = vec2(
			hash3D( floor( pixScales.x * position.xyz ) ),
			hash3D( floor( pixScales.y * position.xyz ) )
		);
		float lerpFactor = fract( log2( pixScale ) );
		float x = ( 1.0 - lerpFactor ) * alpha.x + lerpFactor * alpha.y;
		float a = min( lerpFactor, 1.0 - lerpFactor );
		vec3 cases = vec3(
			x * x / ( 2.0 * a * ( 1.0 - a ) ),
			( x - 0.5 * a ) / ( 1.0 - a ),
			1.0 - ( ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) ) )
		);
		float threshold = ( x < ( 1.0 - a ) )
			? ( ( x < a ) ? cases.x : cases.y )
			: cases.z;
		return clamp( threshold , 1.0e-6, 1.0 );
	}
#endif`,hb=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,ub=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,fb=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,db=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,pb=`#ifdef USE_AOMAP
	float ambientOcclusion = ( texture2D( aoMap, vAoMapUv ).r - 1.0 ) * aoMapIntensity + 1.0;
	reflectedLight.indirectDiffuse *= ambientOcclusion;
	#if defined( USE_CLEARCOAT ) 
		clearcoatSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_SHEEN ) 
		sheenSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD )
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		reflectedLight.indirectSpecular *= computeSpecularOcclusion( dotNV, ambientOcclusion, material.roughness );
	#endif
#endif`,mb=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,gb=`#ifdef USE_BATCHING
	#if ! defined( GL_ANGLE_multi_draw )
	#define gl_DrawID _gl_DrawID
	uniform int _gl_DrawID;
	#endif
	uniform highp sampler2D batchingTexture;
	uniform highp usampler2D batchingIdTexture;
	mat4 getBatchingMatrix( const in float i ) {
		int size = textureSize( batchingTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( batchingTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( batchingTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( batchingTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( batchingTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
	float getIndirectIndex( const in int i ) {
		int size = textureSize( batchingIdTexture, 0 ).x;
		int x = i % size;
		int y = i / size;
		return float( texelFetch( batchingIdTexture, ivec2( x, y ), 0 ).r );
	}
#endif
#ifdef USE_BATCHING_COLOR
	uniform sampler2D batchingColorTexture;
	vec4 getBatchingColor( const in float i ) {
		int size = textureSize( batchingColorTexture, 0 ).x;
		int j = int( i );
		int x = j % size;
		int y = j / size;
		return texelFetch( batchingColorTexture, ivec2( x, y ), 0 );
	}
#endif`,_b=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,xb=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,yb=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,vb=`float G_BlinnPhong_Implicit( ) {
	return 0.25;
}
float D_BlinnPhong( const in float shininess, const in float dotNH ) {
	return RECIPROCAL_PI * ( shininess * 0.5 + 1.0 ) * pow( dotNH, shininess );
}
vec3 BRDF_BlinnPhong( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 specularColor, const in float shininess ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( specularColor, 1.0, dotVH );
	float G = G_BlinnPhong_Implicit( );
	float D = D_BlinnPhong( shininess, dotNH );
	return F * ( G * D );
} // validated`,bb=`#ifdef USE_IRIDESCENCE
	const mat3 XYZ_TO_REC709 = mat3(
		 3.2404542, -0.9692660,  0.0556434,
		-1.5371385,  1.8760108, -0.2040259,
		-0.4985314,  0.0415560,  1.0572252
	);
	vec3 Fresnel0ToIor( vec3 fresnel0 ) {
		vec3 sqrtF0 = sqrt( fresnel0 );
		return ( vec3( 1.0 ) + sqrtF0 ) / ( vec3( 1.0 ) - sqrtF0 );
	}
	vec3 IorToFresnel0( vec3 transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - vec3( incidentIor ) ) / ( transmittedIor + vec3( incidentIor ) ) );
	}
	float IorToFresnel0( float transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - incidentIor ) / ( transmittedIor + incidentIor ));
	}
	vec3 evalSensitivity( float OPD, vec3 shift ) {
		float phase = 2.0 * PI * OPD * 1.0e-9;
		vec3 val = vec3( 5.4856e-13, 4.4201e-13, 5.2481e-13 );
		vec3 pos = vec3( 1.6810e+06, 1.7953e+06, 2.2084e+06 );
		vec3 var = vec3( 4.3278e+09, 9.3046e+09, 6.6121e+09 );
		vec3 xyz = val * sqrt( 2.0 * PI * var ) * cos( pos * phase + shift ) * exp( - pow2( phase ) * var );
		xyz.x += 9.7470e-14 * sqrt( 2.0 * PI * 4.5282e+09 ) * cos( 2.2399e+06 * phase + shift[ 0 ] ) * exp( - 4.5282e+09 * pow2( phase ) );
		xyz /= 1.0685e-7;
		vec3 rgb = XYZ_TO_REC709 * xyz;
		return rgb;
	}
	vec3 evalIridescence( float outsideIOR, float eta2, float cosTheta1, float thinFilmThickness, vec3 baseF0 ) {
		vec3 I;
		float iridescenceIOR = mix( outsideIOR, eta2, smoothstep( 0.0, 0.03, thinFilmThickness ) );
		float sinTheta2Sq = pow2( outsideIOR / iridescenceIOR ) * ( 1.0 - pow2( cosTheta1 ) );
		float cosTheta2Sq = 1.0 - sinTheta2Sq;
		if ( cosTheta2Sq < 0.0 ) {
			return vec3( 1.0 );
		}
		float cosTheta2 = sqrt( cosTheta2Sq );
		float R0 = IorToFresnel0( iridescenceIOR, outsideIOR );
		float R12 = F_Schlick( R0, 1.0, cosTheta1 );
		float T121 = 1.0 - R12;
		float phi12 = 0.0;
		if ( iridescenceIOR < outsideIOR ) phi12 = PI;
		float phi21 = PI - phi12;
		vec3 baseIOR = Fresnel0ToIor( clamp( baseF0, 0.0, 0.9999 ) );		vec3 R1 = IorToFresnel0( baseIOR, iridescenceIOR );
		vec3 R23 = F_Schlick( R1, 1.0, cosTheta2 );
		vec3 phi23 = vec3( 0.0 );
		if ( baseIOR[ 0 ] < iridescenceIOR ) phi23[ 0 ] = PI;
		if ( baseIOR[ 1 ] < iridescenceIOR ) phi23[ 1 ] = PI;
		if ( baseIOR[ 2 ] < iridescenceIOR ) phi23[ 2 ] = PI;
		float OPD = 2.0 * iridescenceIOR * thinFilmThickness * cosTheta2;
		vec3 phi = vec3( phi21 ) + phi23;
		vec3 R123 = clamp( R12 * R23, 1e-5, 0.9999 );
		vec3 r123 = sqrt( R123 );
		vec3 Rs = pow2( T121 ) * R23 / ( vec3( 1.0 ) - R123 );
		vec3 C0 = R12 + Rs;
		I = C0;
		vec3 Cm = Rs - T121;
		for ( int m = 1; m <= 2; ++ m ) {
			Cm *= r123;
			vec3 Sm = 2.0 * evalSensitivity( float( m ) * OPD, float( m ) * phi );
			I += Cm * Sm;
		}
		return max( I, vec3( 0.0 ) );
	}
#endif`,Mb=`#ifdef USE_BUMPMAP
	uniform sampler2D bumpMap;
	uniform float bumpScale;
	vec2 dHdxy_fwd() {
		vec2 dSTdx = dFdx( vBumpMapUv );
		vec2 dSTdy = dFdy( vBumpMapUv );
		float Hll = bumpScale * texture2D( bumpMap, vBumpMapUv ).x;
		float dBx = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdx ).x - Hll;
		float dBy = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdy ).x - Hll;
		return vec2( dBx, dBy );
	}
	vec3 perturbNormalArb( vec3 surf_pos, vec3 surf_norm, vec2 dHdxy, float faceDirection ) {
		vec3 vSigmaX = normalize( dFdx( surf_pos.xyz ) );
		vec3 vSigmaY = normalize( dFdy( surf_pos.xyz ) );
		vec3 vN = surf_norm;
		vec3 R1 = cross( vSigmaY, vN );
		vec3 R2 = cross( vN, vSigmaX );
		float fDet = dot( vSigmaX, R1 ) * faceDirection;
		vec3 vGrad = sign( fDet ) * ( dHdxy.x * R1 + dHdxy.y * R2 );
		return normalize( abs( fDet ) * surf_norm - vGrad );
	}
#endif`,Sb=`#if NUM_CLIPPING_PLANES > 0
	vec4 plane;
	#ifdef ALPHA_TO_COVERAGE
		float distanceToPlane, distanceGradient;
		float clipOpacity = 1.0;
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
			distanceGradient = fwidth( distanceToPlane ) / 2.0;
			clipOpacity *= smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			if ( clipOpacity == 0.0 ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			float unionClipOpacity = 1.0;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
				distanceGradient = fwidth( distanceToPlane ) / 2.0;
				unionClipOpacity *= 1.0 - smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			}
			#pragma unroll_loop_end
			clipOpacity *= 1.0 - unionClipOpacity;
		#endif
		diffuseColor.a *= clipOpacity;
		if ( diffuseColor.a == 0.0 ) discard;
	#else
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			if ( dot( vClipPosition, plane.xyz ) > plane.w ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			bool clipped = true;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				clipped = ( dot( vClipPosition, plane.xyz ) > plane.w ) && clipped;
			}
			#pragma unroll_loop_end
			if ( clipped ) discard;
		#endif
	#endif
#endif`,wb=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,Eb=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,Ab=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,Tb=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,Cb=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,Rb=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,Pb=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	vColor = vec4( 1.0 );
#endif
#ifdef USE_COLOR_ALPHA
	vColor *= color;
#elif defined( USE_COLOR )
	vColor.rgb *= color;
#endif
#ifdef USE_INSTANCING_COLOR
	vColor.rgb *= instanceColor.rgb;
#endif
#ifdef USE_BATCHING_COLOR
	vColor *= getBatchingColor( getIndirectIndex( gl_DrawID ) );
#endif`,Ib=`#define PI 3.141592653589793
#define PI2 6.283185307179586
#define PI_HALF 1.5707963267948966
#define RECIPROCAL_PI 0.3183098861837907
#define RECIPROCAL_PI2 0.15915494309189535
#define EPSILON 1e-6
#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
#define whiteComplement( a ) ( 1.0 - saturate( a ) )
float pow2( const in float x ) { return x*x; }
vec3 pow2( const in vec3 x ) { return x*x; }
float pow3( const in float x ) { return x*x*x; }
float pow4( const in float x ) { float x2 = x*x; return x2*x2; }
float max3( const in vec3 v ) { return max( max( v.x, v.y ), v.z ); }
float average( const in vec3 v ) { return dot( v, vec3( 0.3333333 ) ); }
highp float rand( const in vec2 uv ) {
	const highp float a = 12.9898, b = 78.233, c = 43758.5453;
	highp float dt = dot( uv.xy, vec2( a,b ) ), sn = mod( dt, PI );
	return fract( sin( sn ) * c );
}
#ifdef HIGH_PRECISION
	float precisionSafeLength( vec3 v ) { return length( v ); }
#else
	float precisionSafeLength( vec3 v ) {
		float maxComponent = max3( abs( v ) );
		return length( v / maxComponent ) * maxComponent;
	}
#endif
struct IncidentLight {
	vec3 color;
	vec3 direction;
	bool visible;
};
struct ReflectedLight {
	vec3 directDiffuse;
	vec3 directSpecular;
	vec3 indirectDiffuse;
	vec3 indirectSpecular;
};
#ifdef USE_ALPHAHASH
	varying vec3 vPosition;
#endif
vec3 transformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );
}
#define inverseTransformDirection transformDirectionByInverseViewMatrix
vec3 transformNormalByInverseViewMatrix( in vec3 normal, in mat4 viewMatrix ) {
	return normalize( ( vec4( normal, 0.0 ) * viewMatrix ).xyz );
}
vec3 transformDirectionByInverseViewMatrix( in vec3 dir, in mat4 viewMatrix ) {
	return normalize( ( vec4( dir, 0.0 ) * viewMatrix ).xyz );
}
bool isPerspectiveMatrix( mat4 m ) {
	return m[ 2 ][ 3 ] == - 1.0;
}
vec2 equirectUv( in vec3 dir ) {
	float u = atan( dir.z, dir.x ) * RECIPROCAL_PI2 + 0.5;
	float v = asin( clamp( dir.y, - 1.0, 1.0 ) ) * RECIPROCAL_PI + 0.5;
	return vec2( u, v );
}
vec3 BRDF_Lambert( const in vec3 diffuseColor ) {
	return RECIPROCAL_PI * diffuseColor;
}
vec3 F_Schlick( const in vec3 f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
}
float F_Schlick( const in float f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
} // validated`,Lb=`vec3 transformedNormal = objectNormal;
#ifdef USE_TANGENT
	vec3 transformedTangent = objectTangent;
#endif
#ifdef USE_BATCHING
	mat3 bm = mat3( batchingMatrix );
	transformedNormal /= vec3( dot( bm[ 0 ], bm[ 0 ] ), dot( bm[ 1 ], bm[ 1 ] ), dot( bm[ 2 ], bm[ 2 ] ) );
	transformedNormal = bm * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = bm * transformedTangent;
	#endif
#endif
#ifdef USE_INSTANCING
	mat3 im = mat3( instanceMatrix );
	transformedNormal /= vec3( dot( im[ 0 ], im[ 0 ] ), dot( im[ 1 ], im[ 1 ] ), dot( im[ 2 ], im[ 2 ] ) );
	transformedNormal = im * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = im * transformedTangent;
	#endif
#endif
transformedNormal = normalMatrix * transformedNormal;
#ifdef FLIP_SIDED
	transformedNormal = - transformedNormal;
#endif
#ifdef USE_TANGENT
	transformedTangent = ( modelViewMatrix * vec4( transformedTangent, 0.0 ) ).xyz;
#endif`,Nb=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,Db=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,Ub=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,Ob=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,Fb="gl_FragColor = linearToOutputTexel( gl_FragColor );",Bb=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,kb=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vec3 cameraToFrag;
		if ( isOrthographic ) {
			cameraToFrag = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToFrag = normalize( vWorldPosition - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vec3 reflectVec = reflect( cameraToFrag, worldNormal );
		#else
			vec3 reflectVec = refract( cameraToFrag, worldNormal, refractionRatio );
		#endif
	#else
		vec3 reflectVec = vReflect;
	#endif
	#ifdef ENVMAP_TYPE_CUBE
		vec4 envColor = textureCube( envMap, envMapRotation * reflectVec );
		#ifdef ENVMAP_BLENDING_MULTIPLY
			outgoingLight = mix( outgoingLight, outgoingLight * envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_MIX )
			outgoingLight = mix( outgoingLight, envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_ADD )
			outgoingLight += envColor.xyz * specularStrength * reflectivity;
		#endif
	#endif
#endif`,zb=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,Vb=`#ifdef USE_ENVMAP
	uniform float reflectivity;
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		varying vec3 vWorldPosition;
		uniform float refractionRatio;
	#else
		varying vec3 vReflect;
	#endif
#endif`,Gb=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,Hb=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vWorldPosition = worldPosition.xyz;
	#else
		vec3 cameraToVertex;
		if ( isOrthographic ) {
			cameraToVertex = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToVertex = normalize( worldPosition.xyz - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vReflect = reflect( cameraToVertex, worldNormal );
		#else
			vReflect = refract( cameraToVertex, worldNormal, refractionRatio );
		#endif
	#endif
#endif`,Wb=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,Xb=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,$b=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,qb=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,Yb=`#ifdef USE_GRADIENTMAP
	uniform sampler2D gradientMap;
#endif
vec3 getGradientIrradiance( vec3 normal, vec3 lightDirection ) {
	float dotNL = dot( normal, lightDirection );
	vec2 coord = vec2( dotNL * 0.5 + 0.5, 0.0 );
	#ifdef USE_GRADIENTMAP
		return vec3( texture2D( gradientMap, coord ).r );
	#else
		vec2 fw = fwidth( coord ) * 0.5;
		return mix( vec3( 0.7 ), vec3( 1.0 ), smoothstep( 0.7 - fw.x, 0.7 + fw.x, coord.x ) );
	#endif
}`,Zb=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,Jb=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,Kb=`varying vec3 vViewPosition;
struct LambertMaterial {
	vec3 diffuseColor;
	float specularStrength;
};
void RE_Direct_Lambert( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Lambert( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Lambert
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,jb=`uniform bool receiveShadow;
uniform vec3 ambientLightColor;
#if defined( USE_LIGHT_PROBES )
	uniform vec3 lightProbe[ 9 ];
#endif
vec3 shGetIrradianceAt( in vec3 normal, in vec3 shCoefficients[ 9 ] ) {
	float x = normal.x, y = normal.y, z = normal.z;
	vec3 result = shCoefficients[ 0 ] * 0.886227;
	result += shCoefficients[ 1 ] * 2.0 * 0.511664 * y;
	result += shCoefficients[ 2 ] * 2.0 * 0.511664 * z;
	result += shCoefficients[ 3 ] * 2.0 * 0.511664 * x;
	result += shCoefficients[ 4 ] * 2.0 * 0.429043 * x * y;
	result += shCoefficients[ 5 ] * 2.0 * 0.429043 * y * z;
	result += shCoefficients[ 6 ] * ( 0.743125 * z * z - 0.247708 );
	result += shCoefficients[ 7 ] * 2.0 * 0.429043 * x * z;
	result += shCoefficients[ 8 ] * 0.429043 * ( x * x - y * y );
	return result;
}
vec3 getLightProbeIrradiance( const in vec3 lightProbe[ 9 ], const in vec3 normal ) {
	vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec3 irradiance = shGetIrradianceAt( worldNormal, lightProbe );
	return irradiance;
}
vec3 getAmbientLightIrradiance( const in vec3 ambientLightColor ) {
	vec3 irradiance = ambientLightColor;
	return irradiance;
}
float getDistanceAttenuation( const in float lightDistance, const in float cutoffDistance, const in float decayExponent ) {
	float distanceFalloff = 1.0 / max( pow( lightDistance, decayExponent ), 0.01 );
	if ( cutoffDistance > 0.0 ) {
		distanceFalloff *= pow2( saturate( 1.0 - pow4( lightDistance / cutoffDistance ) ) );
	}
	return distanceFalloff;
}
float getSpotAttenuation( const in float coneCosine, const in float penumbraCosine, const in float angleCosine ) {
	return smoothstep( coneCosine, penumbraCosine, angleCosine );
}
#if NUM_SUN_LIGHTS > 0
	struct SunLight {
		vec3 direction;
		vec3 color;
	};
	uniform SunLight sunLights[ NUM_SUN_LIGHTS ];
	void getSunLightInfo( const in SunLight sunLight, out IncidentLight light ) {
		light.color = sunLight.color;
		light.direction = sunLight.direction;
		light.visible = true;
	}
#endif
#if NUM_DIR_LIGHTS > 0
	struct DirectionalLight {
		vec3 direction;
		vec3 color;
	};
	uniform DirectionalLight directionalLights[ NUM_DIR_LIGHTS ];
	void getDirectionalLightInfo( const in DirectionalLight directionalLight, out IncidentLight light ) {
		light.color = directionalLight.color;
		light.direction = directionalLight.direction;
		light.visible = true;
	}
#endif
#if NUM_POINT_LIGHTS > 0
	struct PointLight {
		vec3 position;
		vec3 color;
		float distance;
		float decay;
	};
	uniform PointLight pointLights[ NUM_POINT_LIGHTS ];
	void getPointLightInfo( const in PointLight pointLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = pointLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float lightDistance = length( lVector );
		light.color = pointLight.color;
		light.color *= getDistanceAttenuation( lightDistance, pointLight.distance, pointLight.decay );
		light.visible = ( light.color != vec3( 0.0 ) );
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	struct SpotLight {
		vec3 position;
		vec3 direction;
		vec3 color;
		float distance;
		float decay;
		float coneCos;
		float penumbraCos;
	};
	uniform SpotLight spotLights[ NUM_SPOT_LIGHTS ];
	void getSpotLightInfo( const in SpotLight spotLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = spotLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float angleCos = dot( light.direction, spotLight.direction );
		float spotAttenuation = getSpotAttenuation( spotLight.coneCos, spotLight.penumbraCos, angleCos );
		if ( spotAttenuation > 0.0 ) {
			float lightDistance = length( lVector );
			light.color = spotLight.color * spotAttenuation;
			light.color *= getDistanceAttenuation( lightDistance, spotLight.distance, spotLight.decay );
			light.visible = ( light.color != vec3( 0.0 ) );
		} else {
			light.color = vec3( 0.0 );
			light.visible = false;
		}
	}
#endif
#if NUM_RECT_AREA_LIGHTS > 0
	struct RectAreaLight {
		vec3 color;
		vec3 position;
		vec3 halfWidth;
		vec3 halfHeight;
	};
	uniform sampler2D ltc_1;	uniform sampler2D ltc_2;
	uniform RectAreaLight rectAreaLights[ NUM_RECT_AREA_LIGHTS ];
#endif
#if NUM_HEMI_LIGHTS > 0
	struct HemisphereLight {
		vec3 direction;
		vec3 skyColor;
		vec3 groundColor;
	};
	uniform HemisphereLight hemisphereLights[ NUM_HEMI_LIGHTS ];
	vec3 getHemisphereLightIrradiance( const in HemisphereLight hemiLight, const in vec3 normal ) {
		float dotNL = dot( normal, hemiLight.direction );
		float hemiDiffuseWeight = 0.5 * dotNL + 0.5;
		vec3 irradiance = mix( hemiLight.groundColor, hemiLight.skyColor, hemiDiffuseWeight );
		return irradiance;
	}
#endif
#include <lightprobes_pars_fragment>`,Qb=`#ifdef USE_ENVMAP
	vec3 getIBLIrradiance( const in vec3 normal ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * worldNormal, ENVMAP_MAX_LOD );
			return PI * envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	vec3 getIBLRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 reflectVec = reflect( - viewDir, normal );
			reflectVec = normalize( mix( reflectVec, normal, pow4( roughness ) ) );
			reflectVec = transformDirectionByInverseViewMatrix( reflectVec, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * reflectVec, roughnessToMip( roughness ) );
			return envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	#ifdef USE_RETROREFLECTION
		vec3 getIBLRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 retroVec = normalize( mix( viewDir, normal, pow4( roughness ) ) );
				retroVec = transformDirectionByInverseViewMatrix( retroVec, viewMatrix );
				vec4 envMapColor = textureLod( envMap, envMapRotation * retroVec, roughnessToMip( roughness ) );
				return envMapColor.rgb * envMapIntensity;
			#else
				return vec3( 0.0 );
			#endif
		}
	#endif
	#ifdef USE_ANISOTROPY
		vec3 getIBLAnisotropyRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 bentNormal = cross( bitangent, viewDir );
				bentNormal = normalize( cross( bentNormal, bitangent ) );
				bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
				return getIBLRadiance( viewDir, bentNormal, roughness );
			#else
				return vec3( 0.0 );
			#endif
		}
		#ifdef USE_RETROREFLECTION
			vec3 getIBLAnisotropyRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
				#ifdef ENVMAP_TYPE_PMREM
					vec3 bentNormal = cross( bitangent, viewDir );
					bentNormal = normalize( cross( bentNormal, bitangent ) );
					bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
					return getIBLRetroRadiance( viewDir, bentNormal, roughness );
				#else
					return vec3( 0.0 );
				#endif
			}
		#endif
	#endif
#endif`,tM=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,eM=`varying vec3 vViewPosition;
struct ToonMaterial {
	vec3 diffuseColor;
};
void RE_Direct_Toon( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 irradiance = getGradientIrradiance( geometryNormal, directLight.direction ) * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Toon( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Toon
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,nM=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,iM=`varying vec3 vViewPosition;
struct BlinnPhongMaterial {
	vec3 diffuseColor;
	vec3 specularColor;
	float specularShininess;
	float specularStrength;
};
void RE_Direct_BlinnPhong( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
	reflectedLight.directSpecular += irradiance * BRDF_BlinnPhong( directLight.direction, geometryViewDir, geometryNormal, material.specularColor, material.specularShininess ) * material.specularStrength;
}
void RE_IndirectDiffuse_BlinnPhong( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_BlinnPhong
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,sM=`PhysicalMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.diffuseContribution = diffuseColor.rgb * ( 1.0 - metalnessFactor );
material.metalness = metalnessFactor;
vec3 dxy = max( abs( dFdx( nonPerturbedNormal ) ), abs( dFdy( nonPerturbedNormal ) ) );
float geometryRoughness = max( max( dxy.x, dxy.y ), dxy.z );
material.roughness = max( roughnessFactor, 0.045 );
material.roughness += geometryRoughness;
material.roughness = min( material.roughness, 1.0 );
#ifdef USE_DIFFUSE_ROUGHNESS
	float diffuseRoughnessFactor = diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		diffuseRoughnessFactor *= texture2D( diffuseRoughnessMap, vDiffuseRoughnessMapUv ).r;
	#endif
	material.diffuseRoughness = saturate( diffuseRoughnessFactor );
#endif
#ifdef IOR
	material.ior = ior;
	#ifdef USE_SPECULAR
		float specularIntensityFactor = specularIntensity;
		vec3 specularColorFactor = specularColor;
		#ifdef USE_SPECULAR_COLORMAP
			specularColorFactor *= texture2D( specularColorMap, vSpecularColorMapUv ).rgb;
		#endif
		#ifdef USE_SPECULAR_INTENSITYMAP
			specularIntensityFactor *= texture2D( specularIntensityMap, vSpecularIntensityMapUv ).a;
		#endif
		material.specularF90 = mix( specularIntensityFactor, 1.0, metalnessFactor );
	#else
		float specularIntensityFactor = 1.0;
		vec3 specularColorFactor = vec3( 1.0 );
		material.specularF90 = 1.0;
	#endif
	material.specularColor = min( pow2( ( material.ior - 1.0 ) / ( material.ior + 1.0 ) ) * specularColorFactor, vec3( 1.0 ) ) * specularIntensityFactor;
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
#else
	material.specularColor = vec3( 0.04 );
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
	material.specularF90 = 1.0;
#endif
#ifdef USE_CLEARCOAT
	material.clearcoat = clearcoat;
	material.clearcoatRoughness = clearcoatRoughness;
	material.clearcoatF0 = vec3( 0.04 );
	material.clearcoatF90 = 1.0;
	#ifdef USE_CLEARCOATMAP
		material.clearcoat *= texture2D( clearcoatMap, vClearcoatMapUv ).x;
	#endif
	#ifdef USE_CLEARCOAT_ROUGHNESSMAP
		material.clearcoatRoughness *= texture2D( clearcoatRoughnessMap, vClearcoatRoughnessMapUv ).y;
	#endif
	material.clearcoat = saturate( material.clearcoat );	material.clearcoatRoughness = max( material.clearcoatRoughness, 0.045 );
	material.clearcoatRoughness += geometryRoughness;
	material.clearcoatRoughness = min( material.clearcoatRoughness, 1.0 );
#endif
#ifdef USE_DISPERSION
	material.dispersion = dispersion;
#endif
#ifdef USE_RETROREFLECTION
	material.retroreflectivity = retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	material.iridescence = iridescence;
	material.iridescenceIOR = iridescenceIOR;
	#ifdef USE_IRIDESCENCEMAP
		material.iridescence *= texture2D( iridescenceMap, vIridescenceMapUv ).r;
	#endif
	#ifdef USE_IRIDESCENCE_THICKNESSMAP
		material.iridescenceThickness = (iridescenceThicknessMaximum - iridescenceThicknessMinimum) * texture2D( iridescenceThicknessMap, vIridescenceThicknessMapUv ).g + iridescenceThicknessMinimum;
	#else
		material.iridescenceThickness = iridescenceThicknessMaximum;
	#endif
#endif
#ifdef USE_SHEEN
	material.sheenColor = sheenColor;
	#ifdef USE_SHEEN_COLORMAP
		material.sheenColor *= texture2D( sheenColorMap, vSheenColorMapUv ).rgb;
	#endif
	material.sheenRoughness = clamp( sheenRoughness, 0.0001, 1.0 );
	#ifdef USE_SHEEN_ROUGHNESSMAP
		material.sheenRoughness *= texture2D( sheenRoughnessMap, vSheenRoughnessMapUv ).a;
	#endif
#endif
#ifdef USE_ANISOTROPY
	#ifdef USE_ANISOTROPYMAP
		mat2 anisotropyMat = mat2( anisotropyVector.x, anisotropyVector.y, - anisotropyVector.y, anisotropyVector.x );
		vec3 anisotropyPolar = texture2D( anisotropyMap, vAnisotropyMapUv ).rgb;
		vec2 anisotropyV = anisotropyMat * normalize( 2.0 * anisotropyPolar.rg - vec2( 1.0 ) ) * anisotropyPolar.b;
	#else
		vec2 anisotropyV = anisotropyVector;
	#endif
	material.anisotropy = length( anisotropyV );
	if( material.anisotropy == 0.0 ) {
		anisotropyV = vec2( 1.0, 0.0 );
	} else {
		anisotropyV /= material.anisotropy;
		material.anisotropy = saturate( material.anisotropy );
	}
	material.alphaT = mix( pow2( material.roughness ), 1.0, pow2( material.anisotropy ) );
	material.anisotropyT = tbn[ 0 ] * anisotropyV.x + tbn[ 1 ] * anisotropyV.y;
	material.anisotropyB = tbn[ 1 ] * anisotropyV.x - tbn[ 0 ] * anisotropyV.y;
#endif`,rM=`uniform sampler2D dfgLUT;
struct PhysicalMaterial {
	vec3 diffuseColor;
	vec3 diffuseContribution;
	vec3 specularColor;
	vec3 specularColorBlended;
	float roughness;
	float metalness;
	float specularF90;
	float dispersion;
	vec2 dfg;
	vec3 multiScatteringCompensation;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float diffuseRoughness;
	#endif
	#ifdef USE_RETROREFLECTION
		float retroreflectivity;
	#endif
	#ifdef USE_CLEARCOAT
		float clearcoat;
		float clearcoatRoughness;
		vec3 clearcoatF0;
		float clearcoatF90;
	#endif
	#ifdef USE_IRIDESCENCE
		float iridescence;
		float iridescenceIOR;
		float iridescenceThickness;
		vec3 iridescenceFresnel;
		vec3 iridescenceF0Dielectric;
		vec3 iridescenceF0Metallic;
	#endif
	#ifdef USE_SHEEN
		vec3 sheenColor;
		float sheenRoughness;
	#endif
	#ifdef IOR
		float ior;
	#endif
	#ifdef USE_TRANSMISSION
		float transmission;
		float transmissionAlpha;
		float thickness;
		float attenuationDistance;
		vec3 attenuationColor;
	#endif
	#ifdef USE_ANISOTROPY
		float anisotropy;
		float alphaT;
		vec3 anisotropyT;
		vec3 anisotropyB;
	#endif
};
vec3 clearcoatSpecularDirect = vec3( 0.0 );
vec3 clearcoatSpecularIndirect = vec3( 0.0 );
vec3 sheenSpecularDirect = vec3( 0.0 );
vec3 sheenSpecularIndirect = vec3(0.0 );
vec3 Schlick_to_F0( const in vec3 f, const in float f90, const in float dotVH ) {
    float x = clamp( 1.0 - dotVH, 0.0, 1.0 );
    float x2 = x * x;
    float x5 = clamp( x * x2 * x2, 0.0, 0.9999 );
    return ( f - vec3( f90 ) * x5 ) / ( 1.0 - x5 );
}
#ifdef USE_DIFFUSE_ROUGHNESS
	const float EON_EPSILON = 1e-7;
	float FON_DirectionalAlbedo( const in float mu, const in float roughness, const in float A ) {
		float muComp = 1.0 - mu;
		float gOverPi = muComp * ( 0.0571085289 + muComp * ( 0.491881867 + muComp * ( - 0.332181442 + muComp * 0.0714429953 ) ) );
		return A * ( 1.0 + roughness * gOverPi );
	}
	vec3 BRDF_EON( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 diffuseColor, const in float roughness ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return BRDF_Lambert( rho );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float s = dot( lightDir, viewDir ) - dotNL * dotNV;
		float sOverT = ( s > 0.0 ) ? s / max( max( dotNL, dotNV ), EON_EPSILON ) : s;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		vec3 singleScatter = rho * RECIPROCAL_PI * A * ( 1.0 + roughness * sOverT );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		float albedoV = FON_DirectionalAlbedo( dotNV, roughness, A );
		float albedoL = FON_DirectionalAlbedo( dotNL, roughness, A );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		vec3 multiScatter = rhoMultiScatter * RECIPROCAL_PI
			* max( EON_EPSILON, 1.0 - albedoV )
			* max( EON_EPSILON, 1.0 - albedoL )
			/ max( EON_EPSILON, 1.0 - averageAlbedo );
		return singleScatter + multiScatter;
	}
	vec3 EON_DirectionalAlbedo( const in vec3 diffuseColor, const in float roughness, const in float dotNV ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return rho;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		float directionalAlbedo = FON_DirectionalAlbedo( dotNV, roughness, A );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		return rho * directionalAlbedo + rhoMultiScatter * ( 1.0 - directionalAlbedo );
	}
#endif
float V_GGX_SmithCorrelated( const in float alpha, const in float dotNL, const in float dotNV ) {
	float a2 = pow2( alpha );
	float gv = dotNL * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNV ) );
	float gl = dotNV * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNL ) );
	return 0.5 / max( gv + gl, EPSILON );
}
float D_GGX( const in float alpha, const in float dotNH ) {
	float a2 = pow2( alpha );
	float denom = pow2( dotNH ) * ( a2 - 1.0 ) + 1.0;
	return RECIPROCAL_PI * a2 / pow2( denom );
}
#ifdef USE_ANISOTROPY
	float V_GGX_SmithCorrelated_Anisotropic( const in float alphaT, const in float alphaB, const in float dotTV, const in float dotBV, const in float dotTL, const in float dotBL, const in float dotNV, const in float dotNL ) {
		float gv = dotNL * length( vec3( alphaT * dotTV, alphaB * dotBV, dotNV ) );
		float gl = dotNV * length( vec3( alphaT * dotTL, alphaB * dotBL, dotNL ) );
		return 0.5 / max( gv + gl, EPSILON );
	}
	float D_GGX_Anisotropic( const in float alphaT, const in float alphaB, const in float dotNH, const in float dotTH, const in float dotBH ) {
		float a2 = alphaT * alphaB;
		highp vec3 v = vec3( alphaB * dotTH, alphaT * dotBH, a2 * dotNH );
		highp float v2 = dot( v, v );
		float w2 = a2 / v2;
		return RECIPROCAL_PI * a2 * pow2 ( w2 );
	}
#endif
#ifdef USE_CLEARCOAT
	vec3 BRDF_GGX_Clearcoat( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material) {
		vec3 f0 = material.clearcoatF0;
		float f90 = material.clearcoatF90;
		float roughness = max( material.clearcoatRoughness, 0.045 );
		float alpha = pow2( roughness );
		vec3 halfDir = normalize( lightDir + viewDir );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float dotNH = saturate( dot( normal, halfDir ) );
		float dotVH = saturate( dot( viewDir, halfDir ) );
		vec3 F = F_Schlick( f0, f90, dotVH );
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
		return F * ( V * D );
	}
#endif
vec3 BRDF_GGX( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material ) {
	vec3 f0 = material.specularColorBlended;
	float f90 = material.specularF90;
	float roughness = max( material.roughness, 0.045 );
	float alpha = pow2( roughness );
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( f0, f90, dotVH );
	#ifdef USE_IRIDESCENCE
		F = mix( F, material.iridescenceFresnel, material.iridescence );
	#endif
	#ifdef USE_ANISOTROPY
		float dotTL = dot( material.anisotropyT, lightDir );
		float dotTV = dot( material.anisotropyT, viewDir );
		float dotTH = dot( material.anisotropyT, halfDir );
		float dotBL = dot( material.anisotropyB, lightDir );
		float dotBV = dot( material.anisotropyB, viewDir );
		float dotBH = dot( material.anisotropyB, halfDir );
		float alphaT = max( material.alphaT, alpha );
		float V = V_GGX_SmithCorrelated_Anisotropic( alphaT, alpha, dotTV, dotBV, dotTL, dotBL, dotNV, dotNL );
		float D = D_GGX_Anisotropic( alphaT, alpha, dotNH, dotTH, dotBH );
	#else
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
	#endif
	return F * ( V * D );
}
vec2 LTC_Uv( const in vec3 N, const in vec3 V, const in float roughness ) {
	const float LUT_SIZE = 64.0;
	const float LUT_SCALE = ( LUT_SIZE - 1.0 ) / LUT_SIZE;
	const float LUT_BIAS = 0.5 / LUT_SIZE;
	float dotNV = saturate( dot( N, V ) );
	vec2 uv = vec2( roughness, sqrt( 1.0 - dotNV ) );
	uv = uv * LUT_SCALE + LUT_BIAS;
	return uv;
}
float LTC_ClippedSphereFormFactor( const in vec3 f ) {
	float l = length( f );
	return max( ( l * l + f.z ) / ( l + 1.0 ), 0.0 );
}
vec3 LTC_EdgeVectorFormFactor( const in vec3 v1, const in vec3 v2 ) {
	float x = dot( v1, v2 );
	float y = abs( x );
	float a = 0.8543985 + ( 0.4965155 + 0.0145206 * y ) * y;
	float b = 3.4175940 + ( 4.1616724 + y ) * y;
	float v = a / b;
	float theta_sintheta = ( x > 0.0 ) ? v : 0.5 * inversesqrt( max( 1.0 - x * x, 1e-7 ) ) - v;
	return cross( v1, v2 ) * theta_sintheta;
}
vec3 LTC_Evaluate( const in vec3 N, const in vec3 V, const in vec3 P, const in mat3 mInv, const in vec3 rectCoords[ 4 ] ) {
	vec3 v1 = rectCoords[ 1 ] - rectCoords[ 0 ];
	vec3 v2 = rectCoords[ 3 ] - rectCoords[ 0 ];
	vec3 lightNormal = cross( v1, v2 );
	if( dot( lightNormal, P - rectCoords[ 0 ] ) < 0.0 ) return vec3( 0.0 );
	vec3 T1, T2;
	T1 = normalize( V - N * dot( V, N ) );
	T2 = - cross( N, T1 );
	mat3 mat = mInv * transpose( mat3( T1, T2, N ) );
	vec3 coords[ 4 ];
	coords[ 0 ] = mat * ( rectCoords[ 0 ] - P );
	coords[ 1 ] = mat * ( rectCoords[ 1 ] - P );
	coords[ 2 ] = mat * ( rectCoords[ 2 ] - P );
	coords[ 3 ] = mat * ( rectCoords[ 3 ] - P );
	coords[ 0 ] = normalize( coords[ 0 ] );
	coords[ 1 ] = normalize( coords[ 1 ] );
	coords[ 2 ] = normalize( coords[ 2 ] );
	coords[ 3 ] = normalize( coords[ 3 ] );
	vec3 vectorFormFactor = vec3( 0.0 );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 0 ], coords[ 1 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 1 ], coords[ 2 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 2 ], coords[ 3 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 3 ], coords[ 0 ] );
	float result = LTC_ClippedSphereFormFactor( vectorFormFactor );
	return vec3( result );
}
#if defined( USE_SHEEN )
float D_Charlie( float roughness, float dotNH ) {
	float alpha = pow2( roughness );
	float invAlpha = 1.0 / alpha;
	float cos2h = dotNH * dotNH;
	float sin2h = max( 1.0 - cos2h, 0.0078125 );
	return ( 2.0 + invAlpha ) * pow( sin2h, invAlpha * 0.5 ) / ( 2.0 * PI );
}
float V_Neubelt( float dotNV, float dotNL ) {
	return saturate( 1.0 / ( 4.0 * ( dotNL + dotNV - dotNL * dotNV ) ) );
}
vec3 BRDF_Sheen( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, vec3 sheenColor, const in float sheenRoughness ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float D = D_Charlie( sheenRoughness, dotNH );
	float V = V_Neubelt( dotNV, dotNL );
	return sheenColor * ( D * V );
}
#endif
float IBLSheenBRDF( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	float r2 = roughness * roughness;
	float rInv = 1.0 / ( roughness + 0.1 );
	float a = -1.9362 + 1.0678 * roughness + 0.4573 * r2 - 0.8469 * rInv;
	float b = -0.6014 + 0.5538 * roughness - 0.4670 * r2 - 0.1255 * rInv;
	float DG = exp( a * dotNV + b );
	return saturate( DG );
}
vec3 EnvironmentBRDF( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	vec2 fab = texture2D( dfgLUT, vec2( roughness, dotNV ) ).rg;
	return specularColor * fab.x + specularF90 * fab.y;
}
#ifdef USE_IRIDESCENCE
void computeMultiscatteringIridescence( const in vec2 fab, const in vec3 specularColor, const in float specularF90, const in float iridescence, const in vec3 iridescenceF0, inout vec3 singleScatter, inout vec3 multiScatter ) {
#else
void computeMultiscattering( const in vec2 fab, const in vec3 specularColor, const in float specularF90, inout vec3 singleScatter, inout vec3 multiScatter ) {
#endif
	#ifdef USE_IRIDESCENCE
		vec3 Fr = mix( specularColor, iridescenceF0, iridescence );
	#else
		vec3 Fr = specularColor;
	#endif
	vec3 FssEss = Fr * fab.x + specularF90 * fab.y;
	float Ess = fab.x + fab.y;
	float Ems = 1.0 - Ess;
	vec3 Favg = Fr + ( 1.0 - Fr ) * 0.047619;	vec3 Fms = FssEss * Favg / ( 1.0 - Ems * Favg );
	singleScatter += FssEss;
	multiScatter += Fms * Ems;
}
#if NUM_RECT_AREA_LIGHTS > 0
	void RE_Direct_RectArea_Physical( const in RectAreaLight rectAreaLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
		vec3 normal = geometryNormal;
		vec3 viewDir = geometryViewDir;
		vec3 position = geometryPosition;
		vec3 lightPos = rectAreaLight.position;
		vec3 halfWidth = rectAreaLight.halfWidth;
		vec3 halfHeight = rectAreaLight.halfHeight;
		vec3 lightColor = rectAreaLight.color;
		float roughness = material.roughness;
		vec3 rectCoords[ 4 ];
		rectCoords[ 0 ] = lightPos + halfWidth - halfHeight;		rectCoords[ 1 ] = lightPos - halfWidth - halfHeight;
		rectCoords[ 2 ] = lightPos - halfWidth + halfHeight;
		rectCoords[ 3 ] = lightPos + halfWidth + halfHeight;
		vec2 uv = LTC_Uv( normal, viewDir, roughness );
		vec4 t1 = texture2D( ltc_1, uv );
		vec4 t2 = texture2D( ltc_2, uv );
		mat3 mInv = mat3(
			vec3( t1.x, 0, t1.y ),
			vec3(    0, 1,    0 ),
			vec3( t1.z, 0, t1.w )
		);
		vec3 fresnel = ( material.specularColorBlended * t2.x + ( material.specularF90 - material.specularColorBlended ) * t2.y );
		reflectedLight.directSpecular += lightColor * fresnel * LTC_Evaluate( normal, viewDir, position, mInv, rectCoords );
		reflectedLight.directDiffuse += lightColor * material.diffuseContribution * LTC_Evaluate( normal, viewDir, position, mat3( 1.0 ), rectCoords );
		#ifdef USE_CLEARCOAT
			vec3 Ncc = geometryClearcoatNormal;
			vec2 uvClearcoat = LTC_Uv( Ncc, viewDir, material.clearcoatRoughness );
			vec4 t1Clearcoat = texture2D( ltc_1, uvClearcoat );
			vec4 t2Clearcoat = texture2D( ltc_2, uvClearcoat );
			mat3 mInvClearcoat = mat3(
				vec3( t1Clearcoat.x, 0, t1Clearcoat.y ),
				vec3(             0, 1,             0 ),
				vec3( t1Clearcoat.z, 0, t1Clearcoat.w )
			);
			vec3 fresnelClearcoat = material.clearcoatF0 * t2Clearcoat.x + ( material.clearcoatF90 - material.clearcoatF0 ) * t2Clearcoat.y;
			clearcoatSpecularDirect += lightColor * fresnelClearcoat * LTC_Evaluate( Ncc, viewDir, position, mInvClearcoat, rectCoords );
		#endif
	}
#endif
void RE_Direct_Physical( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	#ifdef USE_CLEARCOAT
		float dotNLcc = saturate( dot( geometryClearcoatNormal, directLight.direction ) );
		vec3 ccIrradiance = dotNLcc * directLight.color;
		clearcoatSpecularDirect += ccIrradiance * BRDF_GGX_Clearcoat( directLight.direction, geometryViewDir, geometryClearcoatNormal, material );
	#endif
	#ifdef USE_SHEEN
 
 		sheenSpecularDirect += irradiance * BRDF_Sheen( directLight.direction, geometryViewDir, geometryNormal, material.sheenColor, material.sheenRoughness );
 
 		float sheenAlbedoV = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
 		float sheenAlbedoL = IBLSheenBRDF( geometryNormal, directLight.direction, material.sheenRoughness );
 
 		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * max( sheenAlbedoV, sheenAlbedoL );
 
 		irradiance *= sheenEnergyComp;
 
 	#endif
	vec3 specularBRDF = BRDF_GGX( directLight.direction, geometryViewDir, geometryNormal, material );
	#ifdef USE_RETROREFLECTION
		vec3 retroViewDir = reflect( - geometryViewDir, geometryNormal );
		vec3 retroSpecularBRDF = BRDF_GGX( directLight.direction, retroViewDir, geometryNormal, material );
		specularBRDF = mix( specularBRDF, retroSpecularBRDF, saturate( material.retroreflectivity ) );
	#endif
	reflectedLight.directSpecular += irradiance * specularBRDF * material.multiScatteringCompensation;
	vec3 halfDir = normalize( directLight.direction + geometryViewDir );
	float dotVH = saturate( dot( geometryViewDir, halfDir ) );
	vec3 F = F_Schlick( material.specularColor, material.specularF90, dotVH );
	#ifdef USE_RETROREFLECTION
		vec3 retroHalfDir = normalize( directLight.direction + retroViewDir );
		float dotRetroVH = saturate( dot( retroViewDir, retroHalfDir ) );
		vec3 retroF = F_Schlick( material.specularColor, material.specularF90, dotRetroVH );
		F = mix( F, retroF, saturate( material.retroreflectivity ) );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		vec3 diffuseBRDF = BRDF_EON( directLight.direction, geometryViewDir, geometryNormal, material.diffuseColor, material.diffuseRoughness ) * ( 1.0 - material.metalness );
	#else
		vec3 diffuseBRDF = BRDF_Lambert( material.diffuseContribution );
	#endif
	reflectedLight.directDiffuse += irradiance * diffuseBRDF * ( 1.0 - F );
}
void RE_IndirectDiffuse_Physical( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 singleScattering = vec3( 0.0 );
	vec3 multiScattering = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScattering, multiScattering );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScattering, multiScattering );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuseAlbedo = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness );
		vec3 diffuse = irradiance * RECIPROCAL_PI * diffuseAlbedo * ( 1.0 - singleScattering - multiScattering );
	#else
		vec3 diffuse = irradiance * BRDF_Lambert( material.diffuseContribution ) * ( 1.0 - singleScattering - multiScattering );
	#endif
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		sheenSpecularIndirect += irradiance * material.sheenColor * sheenAlbedo * RECIPROCAL_PI;
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		diffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectDiffuse += diffuse;
}
void RE_IndirectSpecular_Physical( const in vec3 radiance, const in vec3 irradiance, const in vec3 clearcoatRadiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight) {
	#ifdef USE_CLEARCOAT
		clearcoatSpecularIndirect += clearcoatRadiance * EnvironmentBRDF( geometryClearcoatNormal, geometryViewDir, material.clearcoatF0, material.clearcoatF90, material.clearcoatRoughness );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularIndirect += irradiance * material.sheenColor * IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness ) * RECIPROCAL_PI;
 	#endif
	vec3 singleScatteringDielectric = vec3( 0.0 );
	vec3 multiScatteringDielectric = vec3( 0.0 );
	vec3 singleScatteringMetallic = vec3( 0.0 );
	vec3 multiScatteringMetallic = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscatteringIridescence( material.dfg, material.diffuseColor, material.specularF90, material.iridescence, material.iridescenceF0Metallic, singleScatteringMetallic, multiScatteringMetallic );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscattering( material.dfg, material.diffuseColor, material.specularF90, singleScatteringMetallic, multiScatteringMetallic );
	#endif
	vec3 singleScattering = mix( singleScatteringDielectric, singleScatteringMetallic, material.metalness );
	vec3 multiScattering = mix( multiScatteringDielectric, multiScatteringMetallic, material.metalness );
	vec3 totalScatteringDielectric = singleScatteringDielectric + multiScatteringDielectric;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuse = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness ) * ( 1.0 - totalScatteringDielectric );
	#else
		vec3 diffuse = material.diffuseContribution * ( 1.0 - totalScatteringDielectric );
	#endif
	vec3 cosineWeightedIrradiance = irradiance * RECIPROCAL_PI;
	vec3 indirectSpecular = radiance * singleScattering;
	indirectSpecular += multiScattering * cosineWeightedIrradiance;
	vec3 indirectDiffuse = diffuse * cosineWeightedIrradiance;
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		indirectSpecular *= sheenEnergyComp;
		indirectDiffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectSpecular += indirectSpecular;
	reflectedLight.indirectDiffuse += indirectDiffuse;
}
#define RE_Direct				RE_Direct_Physical
#define RE_Direct_RectArea		RE_Direct_RectArea_Physical
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Physical
#define RE_IndirectSpecular		RE_IndirectSpecular_Physical
float computeSpecularOcclusion( const in float dotNV, const in float ambientOcclusion, const in float roughness ) {
	return saturate( pow( dotNV + ambientOcclusion, exp2( - 16.0 * roughness - 1.0 ) ) - 1.0 + ambientOcclusion );
}`,oM=`
vec3 geometryPosition = - vViewPosition;
vec3 geometryNormal = normal;
vec3 geometryViewDir = ( isOrthographic ) ? vec3( 0, 0, 1 ) : normalize( vViewPosition );
vec3 geometryClearcoatNormal = vec3( 0.0 );
#ifdef USE_CLEARCOAT
	geometryClearcoatNormal = clearcoatNormal;
#endif
#ifdef USE_IRIDESCENCE
	float dotNVi = saturate( dot( normal, geometryViewDir ) );
	if ( material.iridescenceThickness == 0.0 ) {
		material.iridescence = 0.0;
	} else {
		material.iridescence = saturate( material.iridescence );
	}
	if ( material.iridescence > 0.0 ) {
		vec3 iridescenceFresnelDielectric = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.specularColor );
		vec3 iridescenceFresnelMetallic = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.diffuseColor );
		material.iridescenceFresnel = mix( iridescenceFresnelDielectric, iridescenceFresnelMetallic, material.metalness );
		material.iridescenceF0Dielectric = Schlick_to_F0( iridescenceFresnelDielectric, 1.0, dotNVi );
		material.iridescenceF0Metallic = Schlick_to_F0( iridescenceFresnelMetallic, 1.0, dotNVi );
	}
#endif
#ifdef STANDARD
	float dotNVms = saturate( dot( geometryNormal, geometryViewDir ) );
	material.dfg = texture2D( dfgLUT, vec2( material.roughness, dotNVms ) ).rg;
	#if ( NUM_SUN_LIGHTS > 0 || NUM_DIR_LIGHTS > 0 || NUM_POINT_LIGHTS > 0 || NUM_SPOT_LIGHTS > 0 )
		float EssMs = material.dfg.x + material.dfg.y;
		material.multiScatteringCompensation = 1.0 + material.specularColorBlended * ( 1.0 / EssMs - 1.0 );
	#endif
#endif
IncidentLight directLight;
#if ( NUM_POINT_LIGHTS > 0 ) && defined( RE_Direct )
	PointLight pointLight;
	#if defined( USE_SHADOWMAP ) && NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHTS; i ++ ) {
		pointLight = pointLights[ i ];
		getPointLightInfo( pointLight, geometryPosition, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_POINT_LIGHT_SHADOWS ) && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
		pointLightShadow = pointLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getPointShadow( pointShadowMap[ i ], pointLightShadow.shadowMapSize, pointLightShadow.shadowIntensity, pointLightShadow.shadowBias, pointLightShadow.shadowRadius, vPointShadowCoord[ i ], pointLightShadow.shadowCameraNear, pointLightShadow.shadowCameraFar ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SPOT_LIGHTS > 0 ) && defined( RE_Direct )
	SpotLight spotLight;
	vec4 spotColor;
	vec3 spotLightCoord;
	bool inSpotLightMap;
	#if defined( USE_SHADOWMAP ) && NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHTS; i ++ ) {
		spotLight = spotLights[ i ];
		getSpotLightInfo( spotLight, geometryPosition, directLight );
		#if ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#define SPOT_LIGHT_MAP_INDEX UNROLLED_LOOP_INDEX
		#elif ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		#define SPOT_LIGHT_MAP_INDEX NUM_SPOT_LIGHT_MAPS
		#else
		#define SPOT_LIGHT_MAP_INDEX ( UNROLLED_LOOP_INDEX - NUM_SPOT_LIGHT_SHADOWS + NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#endif
		#if ( SPOT_LIGHT_MAP_INDEX < NUM_SPOT_LIGHT_MAPS )
			spotLightCoord = vSpotLightCoord[ i ].xyz / vSpotLightCoord[ i ].w;
			inSpotLightMap = all( lessThan( abs( spotLightCoord * 2. - 1. ), vec3( 1.0 ) ) );
			spotColor = texture2D( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], spotLightCoord.xy );
			directLight.color = inSpotLightMap ? directLight.color * spotColor.rgb : directLight.color;
		#endif
		#undef SPOT_LIGHT_MAP_INDEX
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		spotLightShadow = spotLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( spotShadowMap[ i ], spotLightShadow.shadowMapSize, spotLightShadow.shadowIntensity, spotLightShadow.shadowBias, spotLightShadow.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SUN_LIGHTS > 0 ) && defined( RE_Direct )
	SunLight sunLight;
	#if defined( USE_SHADOWMAP ) && NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHTS; i ++ ) {
		sunLight = sunLights[ i ];
		getSunLightInfo( sunLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SUN_LIGHT_SHADOWS )
		sunLightShadow = sunLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getSunShadow( sunShadowMap[ i ], sunLightShadow, UNROLLED_LOOP_INDEX ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_DIR_LIGHTS > 0 ) && defined( RE_Direct )
	DirectionalLight directionalLight;
	#if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHTS; i ++ ) {
		directionalLight = directionalLights[ i ];
		getDirectionalLightInfo( directionalLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS )
		directionalLightShadow = directionalLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( directionalShadowMap[ i ], directionalLightShadow.shadowMapSize, directionalLightShadow.shadowIntensity, directionalLightShadow.shadowBias, directionalLightShadow.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_RECT_AREA_LIGHTS > 0 ) && defined( RE_Direct_RectArea )
	RectAreaLight rectAreaLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_RECT_AREA_LIGHTS; i ++ ) {
		rectAreaLight = rectAreaLights[ i ];
		RE_Direct_RectArea( rectAreaLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if defined( RE_IndirectDiffuse )
	vec3 iblIrradiance = vec3( 0.0 );
	vec3 irradiance = getAmbientLightIrradiance( ambientLightColor );
	#if defined( USE_LIGHT_PROBES )
		irradiance += getLightProbeIrradiance( lightProbe, geometryNormal );
	#endif
	#if ( NUM_HEMI_LIGHTS > 0 )
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_HEMI_LIGHTS; i ++ ) {
			irradiance += getHemisphereLightIrradiance( hemisphereLights[ i ], geometryNormal );
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_LIGHT_PROBE_GRIDS > 0
		vec3 probeWorldPos = ( ( vec4( geometryPosition, 1.0 ) - viewMatrix[ 3 ] ) * viewMatrix ).xyz;
		vec3 probeWorldNormal = transformNormalByInverseViewMatrix( geometryNormal, viewMatrix );
		int probeGrid = - 1;
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( isInsideLightProbeGrid( probeWorldPos, probeWorldNormal, probesMin[ i ], probesMax[ i ], probesResolution[ i ] ) ) probeGrid = UNROLLED_LOOP_INDEX;
		}
		#pragma unroll_loop_end
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( probeGrid == UNROLLED_LOOP_INDEX ) irradiance += getLightProbeGridIrradiance( probesSH[ i ], probesMin[ i ], probesMax[ i ], probesResolution[ i ], probeWorldPos, probeWorldNormal );
		}
		#pragma unroll_loop_end
	#endif
#endif
#if defined( RE_IndirectSpecular )
	vec3 radiance = vec3( 0.0 );
	vec3 clearcoatRadiance = vec3( 0.0 );
#endif`,aM=`#if defined( RE_IndirectDiffuse )
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;
		irradiance += lightMapIrradiance;
	#endif
	#if defined( USE_ENVMAP ) && defined( ENVMAP_TYPE_PMREM )
		#if defined( STANDARD ) || defined( LAMBERT ) || defined( PHONG )
			iblIrradiance += getIBLIrradiance( geometryNormal );
		#endif
	#endif
#endif
#if defined( USE_ENVMAP ) && defined( RE_IndirectSpecular )
	#ifdef USE_ANISOTROPY
		vec3 iblRadiance = getIBLAnisotropyRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
	#else
		vec3 iblRadiance = getIBLRadiance( geometryViewDir, geometryNormal, material.roughness );
	#endif
	#ifdef USE_RETROREFLECTION
		#ifdef USE_ANISOTROPY
			vec3 retroIBLRadiance = getIBLAnisotropyRetroRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
		#else
			vec3 retroIBLRadiance = getIBLRetroRadiance( geometryViewDir, geometryNormal, material.roughness );
		#endif
		iblRadiance = mix( iblRadiance, retroIBLRadiance, saturate( material.retroreflectivity ) );
	#endif
	radiance += iblRadiance;
	#ifdef USE_CLEARCOAT
		clearcoatRadiance += getIBLRadiance( geometryViewDir, geometryClearcoatNormal, material.clearcoatRoughness );
	#endif
#endif`,lM=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,cM=`#if NUM_LIGHT_PROBE_GRIDS > 0
uniform highp sampler3D probesSH[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMin[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMax[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesResolution[ NUM_LIGHT_PROBE_GRIDS ];
bool isInsideLightProbeGrid( vec3 worldPos, vec3 worldNormal, vec3 probesMin, vec3 probesMax, vec3 probesResolution ) {
	vec3 spacing = ( probesMax - probesMin ) / probesResolution;
	vec3 samplePos = worldPos + worldNormal * spacing * 0.5;
	vec3 margin = spacing * 0.01;
	return all( greaterThanEqual( samplePos, probesMin - margin ) ) && all( lessThanEqual( samplePos, probesMax + margin ) );
}
vec3 getLightProbeGridIrradiance( highp sampler3D probesSH, vec3 probesMin, vec3 probesMax, vec3 probesResolution, vec3 worldPos, vec3 worldNormal ) {
	vec3 res = probesResolution;
	vec3 gridRange = probesMax - probesMin;
	vec3 probeSpacing = gridRange / res;
	vec3 samplePos = worldPos + worldNormal * probeSpacing * 0.5;
	vec3 uvw = clamp( ( samplePos - probesMin ) / gridRange, 0.5 / res, 1.0 - 0.5 / res );
	float nz          = res.z;
	float paddedSlices = nz + 2.0;
	float atlasDepth  = 7.0 * paddedSlices;
	float uvZBase     = uvw.z * nz + 1.0;
	vec4 s0 = texture( probesSH, vec3( uvw.xy, ( uvZBase                       ) / atlasDepth ) );
	vec4 s1 = texture( probesSH, vec3( uvw.xy, ( uvZBase +       paddedSlices   ) / atlasDepth ) );
	vec4 s2 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 2.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s3 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 3.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s4 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 4.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s5 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 5.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s6 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 6.0 * paddedSlices   ) / atlasDepth ) );
	vec3 c0 = s0.xyz;
	vec3 c1 = vec3( s0.w, s1.xy );
	vec3 c2 = vec3( s1.zw, s2.x );
	vec3 c3 = s2.yzw;
	vec3 c4 = s3.xyz;
	vec3 c5 = vec3( s3.w, s4.xy );
	vec3 c6 = vec3( s4.zw, s5.x );
	vec3 c7 = s5.yzw;
	vec3 c8 = s6.xyz;
	float x = worldNormal.x, y = worldNormal.y, z = worldNormal.z;
	vec3 result = c0 * 0.886227;
	result += c1 * 2.0 * 0.511664 * y;
	result += c2 * 2.0 * 0.511664 * z;
	result += c3 * 2.0 * 0.511664 * x;
	result += c4 * 2.0 * 0.429043 * x * y;
	result += c5 * 2.0 * 0.429043 * y * z;
	result += c6 * ( 0.743125 * z * z - 0.247708 );
	result += c7 * 2.0 * 0.429043 * x * z;
	result += c8 * 0.429043 * ( x * x - y * y );
	return max( result, vec3( 0.0 ) );
}
#endif`,hM=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,uM=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,fM=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,dM=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,pM=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,mM=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,gM=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
	#if defined( USE_POINTS_UV )
		vec2 uv = vUv;
	#else
		vec2 uv = ( uvTransform * vec3( gl_PointCoord.x, 1.0 - gl_PointCoord.y, 1 ) ).xy;
	#endif
#endif
#ifdef USE_MAP
	diffuseColor *= texture2D( map, uv );
#endif
#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, uv ).g;
#endif`,_M=`#if defined( USE_POINTS_UV )
	varying vec2 vUv;
#else
	#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
		uniform mat3 uvTransform;
	#endif
#endif
#ifdef USE_MAP
	uniform sampler2D map;
#endif
#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,xM=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,yM=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,vM=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,bM=`#if defined( USE_MORPHCOLORS )
	#if defined( USE_COLOR_ALPHA )
		vColor *= morphTargetBaseInfluence;
	#elif defined( USE_COLOR )
		vColor.rgb *= morphTargetBaseInfluence;
	#endif
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor.rgb += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,MM=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,SM=`#ifdef USE_MORPHTARGETS
	#ifndef USE_INSTANCING_MORPH
		uniform float morphTargetBaseInfluence;
		uniform float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	#endif
	uniform sampler2DArray morphTargetsTexture;
	uniform ivec2 morphTargetsTextureSize;
	vec4 getMorph( const in int vertexIndex, const in int morphTargetIndex, const in int offset ) {
		int texelIndex = vertexIndex * MORPHTARGETS_TEXTURE_STRIDE + offset;
		int y = texelIndex / morphTargetsTextureSize.x;
		int x = texelIndex - y * morphTargetsTextureSize.x;
		ivec3 morphUV = ivec3( x, y, morphTargetIndex );
		return texelFetch( morphTargetsTexture, morphUV, 0 );
	}
#endif`,wM=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,EM=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
#ifdef FLAT_SHADED
	vec3 fdx = dFdx( vViewPosition );
	vec3 fdy = dFdy( vViewPosition );
	vec3 normal = normalize( cross( fdx, fdy ) );
#else
	vec3 normal = normalize( vNormal );
	#ifdef DOUBLE_SIDED
		normal *= faceDirection;
	#endif
#endif
#if defined( USE_NORMALMAP_TANGENTSPACE ) || defined( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY )
	#ifdef USE_TANGENT
		mat3 tbn = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn = getTangentFrame( - vViewPosition, normal,
		#if defined( USE_NORMALMAP )
			vNormalMapUv
		#elif defined( USE_CLEARCOAT_NORMALMAP )
			vClearcoatNormalMapUv
		#else
			vUv
		#endif
		);
	#endif
	#ifdef DOUBLE_SIDED
		tbn[0] *= faceDirection;
		tbn[1] *= faceDirection;
	#endif
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	#ifdef USE_TANGENT
		mat3 tbn2 = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn2 = getTangentFrame( - vViewPosition, normal, vClearcoatNormalMapUv );
	#endif
	#ifdef DOUBLE_SIDED
		tbn2[0] *= faceDirection;
		tbn2[1] *= faceDirection;
	#endif
#endif
vec3 nonPerturbedNormal = normal;`,AM=`#ifdef USE_NORMALMAP_OBJECTSPACE
	normal = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#ifdef FLIP_SIDED
		normal = - normal;
	#endif
	#ifdef DOUBLE_SIDED
		normal = normal * faceDirection;
	#endif
	normal = normalize( normalMatrix * normal );
#elif defined( USE_NORMALMAP_TANGENTSPACE )
	vec3 mapN = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#if defined( USE_PACKED_NORMALMAP )
		mapN = vec3( mapN.xy, sqrt( saturate( 1.0 - dot( mapN.xy, mapN.xy ) ) ) );
	#endif
	mapN.xy *= normalScale;
	normal = normalize( tbn * mapN );
#elif defined( USE_BUMPMAP )
	normal = perturbNormalArb( - vViewPosition, normal, dHdxy_fwd(), faceDirection );
#endif`,TM=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,CM=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,RM=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,PM=`#ifdef USE_NORMALMAP
	uniform sampler2D normalMap;
	uniform vec2 normalScale;
#endif
#ifdef USE_NORMALMAP_OBJECTSPACE
	uniform mat3 normalMatrix;
#endif
#if ! defined ( USE_TANGENT ) && ( defined ( USE_NORMALMAP_TANGENTSPACE ) || defined ( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY ) )
	mat3 getTangentFrame( vec3 eye_pos, vec3 surf_norm, vec2 uv ) {
		vec3 q0 = dFdx( eye_pos.xyz );
		vec3 q1 = dFdy( eye_pos.xyz );
		vec2 st0 = dFdx( uv.st );
		vec2 st1 = dFdy( uv.st );
		vec3 N = surf_norm;
		vec3 q1perp = cross( q1, N );
		vec3 q0perp = cross( N, q0 );
		vec3 T = q1perp * st0.x + q0perp * st1.x;
		vec3 B = q1perp * st0.y + q0perp * st1.y;
		float det = max( dot( T, T ), dot( B, B ) );
		float scale = ( det == 0.0 ) ? 0.0 : inversesqrt( det );
		return mat3( T * scale, B * scale, N );
	}
#endif`,IM=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,LM=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,NM=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,DM=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,UM=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,OM=`vec3 packNormalToRGB( const in vec3 normal ) {
	return normalize( normal ) * 0.5 + 0.5;
}
vec3 unpackRGBToNormal( const in vec3 rgb ) {
	return 2.0 * rgb.xyz - 1.0;
}
const float PackUpscale = 256. / 255.;const float UnpackDownscale = 255. / 256.;const float ShiftRight8 = 1. / 256.;
const float Inv255 = 1. / 255.;
const vec4 PackFactors = vec4( 1.0, 256.0, 256.0 * 256.0, 256.0 * 256.0 * 256.0 );
const vec2 UnpackFactors2 = vec2( UnpackDownscale, 1.0 / PackFactors.g );
const vec3 UnpackFactors3 = vec3( UnpackDownscale / PackFactors.rg, 1.0 / PackFactors.b );
const vec4 UnpackFactors4 = vec4( UnpackDownscale / PackFactors.rgb, 1.0 / PackFactors.a );
vec4 packDepthToRGBA( const in float v ) {
	if( v <= 0.0 )
		return vec4( 0., 0., 0., 0. );
	if( v >= 1.0 )
		return vec4( 1., 1., 1., 1. );
	float vuf;
	float af = modf( v * PackFactors.a, vuf );
	float bf = modf( vuf * ShiftRight8, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec4( vuf * Inv255, gf * PackUpscale, bf * PackUpscale, af );
}
vec3 packDepthToRGB( const in float v ) {
	if( v <= 0.0 )
		return vec3( 0., 0., 0. );
	if( v >= 1.0 )
		return vec3( 1., 1., 1. );
	float vuf;
	float bf = modf( v * PackFactors.b, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec3( vuf * Inv255, gf * PackUpscale, bf );
}
vec2 packDepthToRG( const in float v ) {
	if( v <= 0.0 )
		return vec2( 0., 0. );
	if( v >= 1.0 )
		return vec2( 1., 1. );
	float vuf;
	float gf = modf( v * 256., vuf );
	return vec2( vuf * Inv255, gf );
}
float unpackRGBAToDepth( const in vec4 v ) {
	return dot( v, UnpackFactors4 );
}
float unpackRGBToDepth( const in vec3 v ) {
	return dot( v, UnpackFactors3 );
}
float unpackRGToDepth( const in vec2 v ) {
	return v.r * UnpackFactors2.r + v.g * UnpackFactors2.g;
}
vec4 pack2HalfToRGBA( const in vec2 v ) {
	vec4 r = vec4( v.x, fract( v.x * 255.0 ), v.y, fract( v.y * 255.0 ) );
	return vec4( r.x - r.y / 255.0, r.y, r.z - r.w / 255.0, r.w );
}
vec2 unpackRGBATo2Half( const in vec4 v ) {
	return vec2( v.x + ( v.y / 255.0 ), v.z + ( v.w / 255.0 ) );
}
float viewZToOrthographicDepth( const in float viewZ, const in float near, const in float far ) {
	return ( viewZ + near ) / ( near - far );
}
float orthographicDepthToViewZ( const in float depth, const in float near, const in float far ) {
	#ifdef USE_REVERSED_DEPTH_BUFFER
	
		return depth * ( far - near ) - far;
	#else
		return depth * ( near - far ) - near;
	#endif
}
float viewZToPerspectiveDepth( const in float viewZ, const in float near, const in float far ) {
	return ( ( near + viewZ ) * far ) / ( ( far - near ) * viewZ );
}
float perspectiveDepthToViewZ( const in float depth, const in float near, const in float far ) {
	
	#ifdef USE_REVERSED_DEPTH_BUFFER
		return ( near * far ) / ( ( near - far ) * depth - near );
	#else
		return ( near * far ) / ( ( far - near ) * depth - far );
	#endif
}`,FM=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,BM=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,kM=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,zM=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,VM=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,GM=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,HM=`#if NUM_SPOT_LIGHT_COORDS > 0
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#if NUM_SPOT_LIGHT_MAPS > 0
	uniform sampler2D spotLightMap[ NUM_SPOT_LIGHT_MAPS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		#define SUN_LIGHT_CASCADES 2
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#else
			uniform sampler2D sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#endif
		uniform mat4 sunShadowMatrix[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		uniform vec4 sunShadowCascade[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
		struct SunLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SunLightShadow sunLightShadows[ NUM_SUN_LIGHT_SHADOWS ];
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#else
			uniform sampler2D directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#endif
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#else
			uniform sampler2D spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#endif
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform samplerCubeShadow pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#elif defined( SHADOWMAP_TYPE_BASIC )
			uniform samplerCube pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#endif
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float interleavedGradientNoise( vec2 position ) {
			return fract( 52.9829189 * fract( dot( position, vec2( 0.06711056, 0.00583715 ) ) ) );
		}
		vec2 vogelDiskSample( int sampleIndex, int samplesCount, float phi ) {
			const float goldenAngle = 2.399963229728653;
			float r = sqrt( ( float( sampleIndex ) + 0.5 ) / float( samplesCount ) );
			float theta = float( sampleIndex ) * goldenAngle + phi;
			return vec2( cos( theta ), sin( theta ) ) * r;
		}
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float getShadow( sampler2DShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
				vec2 radius = shadowRadius * texelSize;
				float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
				shadow = (
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 0, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 1, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 2, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 3, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 4, 5, phi ) * radius, shadowCoord.z ) )
				) * 0.2;
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#elif defined( SHADOWMAP_TYPE_VSM )
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 distribution = texture2D( shadowMap, shadowCoord.xy ).rg;
				float mean = distribution.x;
				float variance = distribution.y * distribution.y;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					float hard_shadow = step( mean, shadowCoord.z );
				#else
					float hard_shadow = step( shadowCoord.z, mean );
				#endif
				
				if ( hard_shadow == 1.0 ) {
					shadow = 1.0;
				} else {
					variance = max( variance, 0.0000001 );
					float d = shadowCoord.z - mean;
					float p_max = variance / ( variance + d * d );
					p_max = clamp( ( p_max - 0.3 ) / 0.65, 0.0, 1.0 );
					shadow = max( hard_shadow, p_max );
				}
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#else
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				float depth = texture2D( shadowMap, shadowCoord.xy ).r;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					shadow = step( depth, shadowCoord.z );
				#else
					shadow = step( shadowCoord.z, depth );
				#endif
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#endif
	#if NUM_SUN_LIGHT_SHADOWS > 0
		float getSunShadow(
			#if defined( SHADOWMAP_TYPE_PCF )
				sampler2DShadow shadowMap,
			#else
				sampler2D shadowMap,
			#endif
			SunLightShadow sunLightShadow,
			int shadowIndex
		) {
			vec4 shadowWorldPosition = vec4( vSunShadowWorldPosition.xyz + vSunShadowWorldNormal * sunLightShadow.shadowNormalBias, 1.0 );
			float viewDepth = vSunShadowWorldPosition.w;
			int cascadeOffset = shadowIndex * SUN_LIGHT_CASCADES;
			float shadow = 1.0;
			for ( int i = SUN_LIGHT_CASCADES - 1; i >= 0; i -- ) {
				vec4 cascade = sunShadowCascade[ cascadeOffset + i ];
				if ( viewDepth >= cascade.x && viewDepth < cascade.y ) {
					float cascadeShadow = getShadow(
						shadowMap,
						sunLightShadow.shadowMapSize,
						sunLightShadow.shadowIntensity,
						sunLightShadow.shadowBias,
						sunLightShadow.shadowRadius,
						sunShadowMatrix[ cascadeOffset + i ] * shadowWorldPosition
					);
					shadow = mix( cascadeShadow, shadow, smoothstep( cascade.z, cascade.y, viewDepth ) );
				}
			}
			return shadow;
		}
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
	#if defined( SHADOWMAP_TYPE_PCF )
	float getPointShadow( samplerCubeShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 bd3D = normalize( lightToPosition );
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float lightDistance = length( lightToPosition );
			float depthRange = shadowCameraFar - shadowCameraNear;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				float depthA = - shadowCameraNear / depthRange - shadowBias;
				float depthB = shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#else
				float depthA = shadowCameraFar / depthRange + shadowBias;
				float depthB = - shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#endif
			float texelSize = shadowRadius / shadowMapSize.x;
			vec3 absDir = abs( bd3D );
			vec3 tangent = absDir.x > absDir.z ? vec3( 0.0, 1.0, 0.0 ) : vec3( 1.0, 0.0, 0.0 );
			tangent = normalize( cross( bd3D, tangent ) );
			vec3 bitangent = cross( bd3D, tangent );
			float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
			shadow = 0.0;
			for ( int i = 0; i < 5; i ++ ) {
				vec2 offset = vogelDiskSample( i, 5, phi );
				vec3 direction = bd3D + ( tangent * offset.x + bitangent * offset.y ) * texelSize;
				vec3 absDirection = abs( direction );
				float dp = depthA + depthB / max( max( absDirection.x, absDirection.y ), absDirection.z );
				shadow += texture( shadowMap, vec4( direction, dp ) );
			}
			shadow *= 0.2;
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#elif defined( SHADOWMAP_TYPE_BASIC )
	float getPointShadow( samplerCube shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float dp = ( shadowCameraFar * ( viewSpaceZ - shadowCameraNear ) ) / ( viewSpaceZ * ( shadowCameraFar - shadowCameraNear ) );
			dp += shadowBias;
			vec3 bd3D = normalize( lightToPosition );
			float depth = textureCube( shadowMap, bd3D ).r;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				depth = 1.0 - depth;
			#endif
			shadow = step( dp, depth );
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#endif
	#endif
#endif`,WM=`#if NUM_SPOT_LIGHT_COORDS > 0
	uniform mat4 spotLightMatrix[ NUM_SPOT_LIGHT_COORDS ];
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform mat4 directionalShadowMatrix[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform mat4 pointShadowMatrix[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
#endif`,XM=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
	#ifdef HAS_NORMAL
		vec3 shadowWorldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
	#else
		vec3 shadowWorldNormal = vec3( 0.0 );
	#endif
	vec4 shadowWorldPosition;
#endif
#if defined( USE_SHADOWMAP )
	#if NUM_SUN_LIGHT_SHADOWS > 0
		vSunShadowWorldPosition = vec4( worldPosition.xyz, - mvPosition.z );
		vSunShadowWorldNormal = shadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0 );
			vDirectionalShadowCoord[ i ] = directionalShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * pointLightShadows[ i ].shadowNormalBias, 0 );
			vPointShadowCoord[ i ] = pointShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
#endif
#if NUM_SPOT_LIGHT_COORDS > 0
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_COORDS; i ++ ) {
		shadowWorldPosition = worldPosition;
		#if ( defined( USE_SHADOWMAP ) && UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
			shadowWorldPosition.xyz += shadowWorldNormal * spotLightShadows[ i ].shadowNormalBias;
		#endif
		vSpotLightCoord[ i ] = spotLightMatrix[ i ] * shadowWorldPosition;
	}
	#pragma unroll_loop_end
#endif`,$M=`float getShadowMask() {
	float shadow = 1.0;
	#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHT_SHADOWS; i ++ ) {
		sunLight = sunLightShadows[ i ];
		shadow *= receiveShadow ? getSunShadow( sunShadowMap[ i ], sunLight, UNROLLED_LOOP_INDEX ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
		directionalLight = directionalLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( directionalShadowMap[ i ], directionalLight.shadowMapSize, directionalLight.shadowIntensity, directionalLight.shadowBias, directionalLight.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_SHADOWS; i ++ ) {
		spotLight = spotLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( spotShadowMap[ i ], spotLight.shadowMapSize, spotLight.shadowIntensity, spotLight.shadowBias, spotLight.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0 && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
	PointLightShadow pointLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
		pointLight = pointLightShadows[ i ];
		shadow *= receiveShadow ? getPointShadow( pointShadowMap[ i ], pointLight.shadowMapSize, pointLight.shadowIntensity, pointLight.shadowBias, pointLight.shadowRadius, vPointShadowCoord[ i ], pointLight.shadowCameraNear, pointLight.shadowCameraFar ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#endif
	return shadow;
}`,qM=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,YM=`#ifdef USE_SKINNING
	uniform mat4 bindMatrix;
	uniform mat4 bindMatrixInverse;
	uniform highp sampler2D boneTexture;
	mat4 getBoneMatrix( const in float i ) {
		int size = textureSize( boneTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( boneTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( boneTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( boneTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( boneTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
#endif`,ZM=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,JM=`#ifdef USE_SKINNING
	mat4 skinMatrix = mat4( 0.0 );
	skinMatrix += skinWeight.x * boneMatX;
	skinMatrix += skinWeight.y * boneMatY;
	skinMatrix += skinWeight.z * boneMatZ;
	skinMatrix += skinWeight.w * boneMatW;
	skinMatrix = bindMatrixInverse * skinMatrix * bindMatrix;
	objectNormal = vec4( skinMatrix * vec4( objectNormal, 0.0 ) ).xyz;
	#ifdef USE_TANGENT
		objectTangent = vec4( skinMatrix * vec4( objectTangent, 0.0 ) ).xyz;
	#endif
#endif`,KM=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,jM=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,QM=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,tS=`#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
uniform float toneMappingExposure;
vec3 LinearToneMapping( vec3 color ) {
	return saturate( toneMappingExposure * color );
}
vec3 ReinhardToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	return saturate( color / ( vec3( 1.0 ) + color ) );
}
vec3 CineonToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	color = max( vec3( 0.0 ), color - 0.004 );
	return pow( ( color * ( 6.2 * color + 0.5 ) ) / ( color * ( 6.2 * color + 1.7 ) + 0.06 ), vec3( 2.2 ) );
}
vec3 RRTAndODTFit( vec3 v ) {
	vec3 a = v * ( v + 0.0245786 ) - 0.000090537;
	vec3 b = v * ( 0.983729 * v + 0.4329510 ) + 0.238081;
	return a / b;
}
vec3 ACESFilmicToneMapping( vec3 color ) {
	const mat3 ACESInputMat = mat3(
		vec3( 0.59719, 0.07600, 0.02840 ),		vec3( 0.35458, 0.90834, 0.13383 ),
		vec3( 0.04823, 0.01566, 0.83777 )
	);
	const mat3 ACESOutputMat = mat3(
		vec3(  1.60475, -0.10208, -0.00327 ),		vec3( -0.53108,  1.10813, -0.07276 ),
		vec3( -0.07367, -0.00605,  1.07602 )
	);
	color *= toneMappingExposure / 0.6;
	color = ACESInputMat * color;
	color = RRTAndODTFit( color );
	color = ACESOutputMat * color;
	return saturate( color );
}
const mat3 LINEAR_REC2020_TO_LINEAR_SRGB = mat3(
	vec3( 1.6605, - 0.1246, - 0.0182 ),
	vec3( - 0.5876, 1.1329, - 0.1006 ),
	vec3( - 0.0728, - 0.0083, 1.1187 )
);
const mat3 LINEAR_SRGB_TO_LINEAR_REC2020 = mat3(
	vec3( 0.6274, 0.0691, 0.0164 ),
	vec3( 0.3293, 0.9195, 0.0880 ),
	vec3( 0.0433, 0.0113, 0.8956 )
);
vec3 agxDefaultContrastApprox( vec3 x ) {
	vec3 x2 = x * x;
	vec3 x4 = x2 * x2;
	return + 15.5 * x4 * x2
		- 40.14 * x4 * x
		+ 31.96 * x4
		- 6.868 * x2 * x
		+ 0.4298 * x2
		+ 0.1191 * x
		- 0.00232;
}
vec3 AgXToneMapping( vec3 color ) {
	const mat3 AgXInsetMatrix = mat3(
		vec3( 0.856627153315983, 0.137318972929847, 0.11189821299995 ),
		vec3( 0.0951212405381588, 0.761241990602591, 0.0767994186031903 ),
		vec3( 0.0482516061458583, 0.101439036467562, 0.811302368396859 )
	);
	const mat3 AgXOutsetMatrix = mat3(
		vec3( 1.1271005818144368, - 0.1413297634984383, - 0.14132976349843826 ),
		vec3( - 0.11060664309660323, 1.157823702216272, - 0.11060664309660294 ),
		vec3( - 0.016493938717834573, - 0.016493938717834257, 1.2519364065950405 )
	);
	const float AgxMinEv = - 12.47393;	const float AgxMaxEv = 4.026069;
	color *= toneMappingExposure;
	color = LINEAR_SRGB_TO_LINEAR_REC2020 * color;
	color = AgXInsetMatrix * color;
	color = max( color, 1e-10 );	color = log2( color );
	color = ( color - AgxMinEv ) / ( AgxMaxEv - AgxMinEv );
	color = clamp( color, 0.0, 1.0 );
	color = agxDefaultContrastApprox( color );
	color = AgXOutsetMatrix * color;
	color = pow( max( vec3( 0.0 ), color ), vec3( 2.2 ) );
	color = LINEAR_REC2020_TO_LINEAR_SRGB * color;
	color = clamp( color, 0.0, 1.0 );
	return color;
}
vec3 NeutralToneMapping( vec3 color ) {
	const float StartCompression = 0.8 - 0.04;
	const float Desaturation = 0.15;
	color *= toneMappingExposure;
	float x = min( color.r, min( color.g, color.b ) );
	float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
	color -= offset;
	float peak = max( color.r, max( color.g, color.b ) );
	if ( peak < StartCompression ) return color;
	float d = 1. - StartCompression;
	float newPeak = 1. - d * d / ( peak + d - StartCompression );
	color *= newPeak / peak;
	float g = 1. - 1. / ( Desaturation * ( peak - newPeak ) + 1. );
	return mix( color, vec3( newPeak ), g );
}
vec3 CustomToneMapping( vec3 color ) { return color; }`,eS=`#ifdef USE_TRANSMISSION
	material.transmission = transmission;
	material.transmissionAlpha = 1.0;
	material.thickness = thickness;
	material.attenuationDistance = attenuationDistance;
	material.attenuationColor = attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		material.transmission *= texture2D( transmissionMap, vTransmissionMapUv ).r;
	#endif
	#ifdef USE_THICKNESSMAP
		material.thickness *= texture2D( thicknessMap, vThicknessMapUv ).g;
	#endif
	vec3 pos = vWorldPosition;
	vec3 v = normalize( cameraPosition - pos );
	vec3 n = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec4 transmitted = getIBLVolumeRefraction(
		n, v, material.roughness, material.diffuseContribution, material.specularColorBlended, material.specularF90,
		pos, modelMatrix, viewMatrix, projectionMatrix, material.dispersion, material.ior, material.thickness,
		material.attenuationColor, material.attenuationDistance );
	material.transmissionAlpha = mix( material.transmissionAlpha, transmitted.a, material.transmission );
	totalDiffuse = mix( totalDiffuse, transmitted.rgb, material.transmission );
#endif`,nS=`#ifdef USE_TRANSMISSION
	uniform float transmission;
	uniform float thickness;
	uniform float attenuationDistance;
	uniform vec3 attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		uniform sampler2D transmissionMap;
	#endif
	#ifdef USE_THICKNESSMAP
		uniform sampler2D thicknessMap;
	#endif
	uniform vec2 transmissionSamplerSize;
	uniform sampler2D transmissionSamplerMap;
	uniform mat4 modelMatrix;
	uniform mat4 projectionMatrix;
	varying vec3 vWorldPosition;
	float w0( float a ) {
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - a + 3.0 ) - 3.0 ) + 1.0 );
	}
	float w1( float a ) {
		return ( 1.0 / 6.0 ) * ( a *  a * ( 3.0 * a - 6.0 ) + 4.0 );
	}
	float w2( float a ){
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - 3.0 * a + 3.0 ) + 3.0 ) + 1.0 );
	}
	float w3( float a ) {
		return ( 1.0 / 6.0 ) * ( a * a * a );
	}
	float g0( float a ) {
		return w0( a ) + w1( a );
	}
	float g1( float a ) {
		return w2( a ) + w3( a );
	}
	float h0( float a ) {
		return - 1.0 + w1( a ) / ( w0( a ) + w1( a ) );
	}
	float h1( float a ) {
		return 1.0 + w3( a ) / ( w2( a ) + w3( a ) );
	}
	vec4 bicubic( sampler2D tex, vec2 uv, vec4 texelSize, float lod ) {
		uv = uv * texelSize.zw + 0.5;
		vec2 iuv = floor( uv );
		vec2 fuv = fract( uv );
		float g0x = g0( fuv.x );
		float g1x = g1( fuv.x );
		float h0x = h0( fuv.x );
		float h1x = h1( fuv.x );
		float h0y = h0( fuv.y );
		float h1y = h1( fuv.y );
		vec2 p0 = ( vec2( iuv.x + h0x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p1 = ( vec2( iuv.x + h1x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p2 = ( vec2( iuv.x + h0x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		vec2 p3 = ( vec2( iuv.x + h1x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		return g0( fuv.y ) * ( g0x * textureLod( tex, p0, lod ) + g1x * textureLod( tex, p1, lod ) ) +
			g1( fuv.y ) * ( g0x * textureLod( tex, p2, lod ) + g1x * textureLod( tex, p3, lod ) );
	}
	vec4 textureBicubic( sampler2D sampler, vec2 uv, float lod ) {
		vec2 fLodSize = vec2( textureSize( sampler, int( lod ) ) );
		vec2 cLodSize = vec2( textureSize( sampler, int( lod + 1.0 ) ) );
		vec2 fLodSizeInv = 1.0 / fLodSize;
		vec2 cLodSizeInv = 1.0 / cLodSize;
		vec4 fSample = bicubic( sampler, uv, vec4( fLodSizeInv, fLodSize ), floor( lod ) );
		vec4 cSample = bicubic( sampler, uv, vec4( cLodSizeInv, cLodSize ), ceil( lod ) );
		return mix( fSample, cSample, fract( lod ) );
	}
	vec3 getVolumeTransmissionRay( const in vec3 n, const in vec3 v, const in float thickness, const in float ior, const in mat4 modelMatrix ) {
		vec3 refractionVector = refract( - v, normalize( n ), 1.0 / ior );
		vec3 modelScale;
		modelScale.x = length( vec3( modelMatrix[ 0 ].xyz ) );
		modelScale.y = length( vec3( modelMatrix[ 1 ].xyz ) );
		modelScale.z = length( vec3( modelMatrix[ 2 ].xyz ) );
		return normalize( refractionVector ) * thickness * modelScale;
	}
	float applyIorToRoughness( const in float roughness, const in float ior ) {
		return roughness * clamp( ior * 2.0 - 2.0, 0.0, 1.0 );
	}
	vec4 getTransmissionSample( const in vec2 fragCoord, const in float roughness, const in float ior ) {
		float lod = log2( transmissionSamplerSize.x ) * applyIorToRoughness( roughness, ior );
		return textureBicubic( transmissionSamplerMap, fragCoord.xy, lod );
	}
	vec3 volumeAttenuation( const in float transmissionDistance, const in vec3 attenuationColor, const in float attenuationDistance ) {
		if ( isinf( attenuationDistance ) ) {
			return vec3( 1.0 );
		} else {
			vec3 attenuationCoefficient = -log( attenuationColor ) / attenuationDistance;
			vec3 transmittance = exp( - attenuationCoefficient * transmissionDistance );			return transmittance;
		}
	}
	vec4 getIBLVolumeRefraction( const in vec3 n, const in vec3 v, const in float roughness, const in vec3 diffuseColor,
		const in vec3 specularColor, const in float specularF90, const in vec3 position, const in mat4 modelMatrix,
		const in mat4 viewMatrix, const in mat4 projMatrix, const in float dispersion, const in float ior, const in float thickness,
		const in vec3 attenuationColor, const in float attenuationDistance ) {
		vec4 transmittedLight;
		vec3 transmittance;
		#ifdef USE_DISPERSION
			float halfSpread = ( ior - 1.0 ) * 0.025 * dispersion;
			vec3 iors = vec3( ior - halfSpread, ior, ior + halfSpread );
			for ( int i = 0; i < 3; i ++ ) {
				vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, iors[ i ], modelMatrix );
				vec3 refractedRayExit = position + transmissionRay;
				vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
				vec2 refractionCoords = ndcPos.xy / ndcPos.w;
				refractionCoords += 1.0;
				refractionCoords /= 2.0;
				vec4 transmissionSample = getTransmissionSample( refractionCoords, roughness, iors[ i ] );
				transmittedLight[ i ] = transmissionSample[ i ];
				transmittedLight.a += transmissionSample.a;
				transmittance[ i ] = diffuseColor[ i ] * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance )[ i ];
			}
			transmittedLight.a /= 3.0;
		#else
			vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, ior, modelMatrix );
			vec3 refractedRayExit = position + transmissionRay;
			vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
			vec2 refractionCoords = ndcPos.xy / ndcPos.w;
			refractionCoords += 1.0;
			refractionCoords /= 2.0;
			transmittedLight = getTransmissionSample( refractionCoords, roughness, ior );
			transmittance = diffuseColor * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance );
		#endif
		vec3 attenuatedColor = transmittance * transmittedLight.rgb;
		vec3 F = EnvironmentBRDF( n, v, specularColor, specularF90, roughness );
		float transmittanceFactor = ( transmittance.r + transmittance.g + transmittance.b ) / 3.0;
		return vec4( ( 1.0 - F ) * attenuatedColor, 1.0 - ( 1.0 - transmittedLight.a ) * transmittanceFactor );
	}
#endif`,iS=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_SPECULARMAP
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,sS=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	uniform mat3 mapTransform;
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	uniform mat3 alphaMapTransform;
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	uniform mat3 lightMapTransform;
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	uniform mat3 aoMapTransform;
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	uniform mat3 bumpMapTransform;
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	uniform mat3 normalMapTransform;
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_DISPLACEMENTMAP
	uniform mat3 displacementMapTransform;
	varying vec2 vDisplacementMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	uniform mat3 emissiveMapTransform;
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	uniform mat3 metalnessMapTransform;
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	uniform mat3 roughnessMapTransform;
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	uniform mat3 diffuseRoughnessMapTransform;
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	uniform mat3 anisotropyMapTransform;
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	uniform mat3 clearcoatMapTransform;
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform mat3 clearcoatNormalMapTransform;
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform mat3 clearcoatRoughnessMapTransform;
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	uniform mat3 sheenColorMapTransform;
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	uniform mat3 sheenRoughnessMapTransform;
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	uniform mat3 iridescenceMapTransform;
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform mat3 iridescenceThicknessMapTransform;
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SPECULARMAP
	uniform mat3 specularMapTransform;
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	uniform mat3 specularColorMapTransform;
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	uniform mat3 specularIntensityMapTransform;
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,rS=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	vUv = vec3( uv, 1 ).xy;
#endif
#ifdef USE_MAP
	vMapUv = ( mapTransform * vec3( MAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ALPHAMAP
	vAlphaMapUv = ( alphaMapTransform * vec3( ALPHAMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_LIGHTMAP
	vLightMapUv = ( lightMapTransform * vec3( LIGHTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_AOMAP
	vAoMapUv = ( aoMapTransform * vec3( AOMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_BUMPMAP
	vBumpMapUv = ( bumpMapTransform * vec3( BUMPMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_NORMALMAP
	vNormalMapUv = ( normalMapTransform * vec3( NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DISPLACEMENTMAP
	vDisplacementMapUv = ( displacementMapTransform * vec3( DISPLACEMENTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_EMISSIVEMAP
	vEmissiveMapUv = ( emissiveMapTransform * vec3( EMISSIVEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_METALNESSMAP
	vMetalnessMapUv = ( metalnessMapTransform * vec3( METALNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ROUGHNESSMAP
	vRoughnessMapUv = ( roughnessMapTransform * vec3( ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	vDiffuseRoughnessMapUv = ( diffuseRoughnessMapTransform * vec3( DIFFUSE_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ANISOTROPYMAP
	vAnisotropyMapUv = ( anisotropyMapTransform * vec3( ANISOTROPYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOATMAP
	vClearcoatMapUv = ( clearcoatMapTransform * vec3( CLEARCOATMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	vClearcoatNormalMapUv = ( clearcoatNormalMapTransform * vec3( CLEARCOAT_NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	vClearcoatRoughnessMapUv = ( clearcoatRoughnessMapTransform * vec3( CLEARCOAT_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCEMAP
	vIridescenceMapUv = ( iridescenceMapTransform * vec3( IRIDESCENCEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	vIridescenceThicknessMapUv = ( iridescenceThicknessMapTransform * vec3( IRIDESCENCE_THICKNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_COLORMAP
	vSheenColorMapUv = ( sheenColorMapTransform * vec3( SHEEN_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	vSheenRoughnessMapUv = ( sheenRoughnessMapTransform * vec3( SHEEN_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULARMAP
	vSpecularMapUv = ( specularMapTransform * vec3( SPECULARMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_COLORMAP
	vSpecularColorMapUv = ( specularColorMapTransform * vec3( SPECULAR_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	vSpecularIntensityMapUv = ( specularIntensityMapTransform * vec3( SPECULAR_INTENSITYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_TRANSMISSIONMAP
	vTransmissionMapUv = ( transmissionMapTransform * vec3( TRANSMISSIONMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_THICKNESSMAP
	vThicknessMapUv = ( thicknessMapTransform * vec3( THICKNESSMAP_UV, 1 ) ).xy;
#endif`,oS=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,aS=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,lS=`uniform sampler2D t2D;
uniform float backgroundIntensity;
varying vec2 vUv;
void main() {
	vec4 texColor = texture2D( t2D, vUv );
	#ifdef DECODE_VIDEO_TEXTURE
		texColor = vec4( mix( pow( texColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), texColor.rgb * 0.0773993808, vec3( lessThanEqual( texColor.rgb, vec3( 0.04045 ) ) ) ), texColor.w );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,cS=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,hS=`uniform float backgroundBlurriness;
uniform float backgroundIntensity;
uniform mat3 backgroundRotation;
varying vec3 vWorldDirection;
#include <envmap_common_pars_fragment>
void main() {
	#ifdef ENVMAP_TYPE_PMREM
		vec4 texColor = textureLod( envMap, backgroundRotation * vWorldDirection, roughnessToMip( backgroundBlurriness ) );
	#else
		vec4 texColor = textureCube( envMap, backgroundRotation * vWorldDirection );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,uS=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,fS=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,dS=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
varying vec2 vHighPrecisionZW;
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vHighPrecisionZW = gl_Position.zw;
}`,pS=`#if DEPTH_PACKING == 3200
	uniform float opacity;
#endif
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
varying vec2 vHighPrecisionZW;
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#if DEPTH_PACKING == 3200
		diffuseColor.a = opacity;
	#endif
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <logdepthbuf_fragment>
	#ifdef USE_REVERSED_DEPTH_BUFFER
		float fragCoordZ = vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ];
	#else
		float fragCoordZ = 0.5 * vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ] + 0.5;
	#endif
	#if DEPTH_PACKING == 3200
		gl_FragColor = vec4( vec3( 1.0 - fragCoordZ ), opacity );
	#elif DEPTH_PACKING == 3201
		gl_FragColor = packDepthToRGBA( fragCoordZ );
	#elif DEPTH_PACKING == 3202
		gl_FragColor = vec4( packDepthToRGB( fragCoordZ ), 1.0 );
	#elif DEPTH_PACKING == 3203
		gl_FragColor = vec4( packDepthToRG( fragCoordZ ), 0.0, 1.0 );
	#endif
}`,mS=`#define DISTANCE
varying vec3 vWorldPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <worldpos_vertex>
	#include <clipping_planes_vertex>
	vWorldPosition = worldPosition.xyz;
}`,gS=`#define DISTANCE
uniform vec3 referencePosition;
uniform float nearDistance;
uniform float farDistance;
varying vec3 vWorldPosition;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	float dist = length( vWorldPosition - referencePosition );
	dist = ( dist - nearDistance ) / ( farDistance - nearDistance );
	dist = saturate( dist );
	gl_FragColor = vec4( dist, 0.0, 0.0, 1.0 );
}`,_S=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,xS=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,yS=`uniform float scale;
attribute float lineDistance;
varying float vLineDistance;
#include <common>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	vLineDistance = scale * lineDistance;
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,vS=`uniform vec3 diffuse;
uniform float opacity;
uniform float dashSize;
uniform float totalSize;
varying float vLineDistance;
#include <common>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	if ( mod( vLineDistance, totalSize ) > dashSize ) {
		discard;
	}
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,bS=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinbase_vertex>
		#include <skinnormal_vertex>
		#include <defaultnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <fog_vertex>
}`,MS=`uniform vec3 diffuse;
uniform float opacity;
#ifndef FLAT_SHADED
	varying vec3 vNormal;
#endif
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		reflectedLight.indirectDiffuse += lightMapTexel.rgb * lightMapIntensity * RECIPROCAL_PI;
	#else
		reflectedLight.indirectDiffuse += vec3( 1.0 );
	#endif
	#include <aomap_fragment>
	reflectedLight.indirectDiffuse *= diffuseColor.rgb;
	vec3 outgoingLight = reflectedLight.indirectDiffuse;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,SS=`#define LAMBERT
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,wS=`#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_lambert_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_lambert_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,ES=`#define MATCAP
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <displacementmap_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
	vViewPosition = - mvPosition.xyz;
}`,AS=`#define MATCAP
uniform vec3 diffuse;
uniform float opacity;
uniform sampler2D matcap;
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	vec3 viewDir = normalize( vViewPosition );
	vec3 x = normalize( vec3( viewDir.z, 0.0, - viewDir.x ) );
	vec3 y = cross( viewDir, x );
	vec2 uv = vec2( dot( x, normal ), dot( y, normal ) ) * 0.495 + 0.5;
	#ifdef USE_MATCAP
		vec4 matcapColor = texture2D( matcap, uv );
	#else
		vec4 matcapColor = vec4( vec3( mix( 0.2, 0.8, uv.y ) ), 1.0 );
	#endif
	vec3 outgoingLight = diffuseColor.rgb * matcapColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,TS=`#define NORMAL
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	vViewPosition = - mvPosition.xyz;
#endif
}`,CS=`#define NORMAL
uniform float opacity;
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <uv_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 0.0, 0.0, 0.0, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	gl_FragColor = vec4( normalize( normal ) * 0.5 + 0.5, diffuseColor.a );
	#ifdef OPAQUE
		gl_FragColor.a = 1.0;
	#endif
}`,RS=`#define PHONG
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,PS=`#define PHONG
uniform vec3 diffuse;
uniform vec3 emissive;
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_phong_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_phong_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + reflectedLight.directSpecular + reflectedLight.indirectSpecular + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,IS=`#define STANDARD
varying vec3 vViewPosition;
#ifdef USE_TRANSMISSION
	varying vec3 vWorldPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
#ifdef USE_TRANSMISSION
	vWorldPosition = worldPosition.xyz;
#endif
}`,LS=`#define STANDARD
#ifdef PHYSICAL
	#define IOR
	#define USE_SPECULAR
#endif
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float roughness;
uniform float metalness;
uniform float opacity;
#ifdef IOR
	uniform float ior;
#endif
#ifdef USE_SPECULAR
	uniform float specularIntensity;
	uniform vec3 specularColor;
	#ifdef USE_SPECULAR_COLORMAP
		uniform sampler2D specularColorMap;
	#endif
	#ifdef USE_SPECULAR_INTENSITYMAP
		uniform sampler2D specularIntensityMap;
	#endif
#endif
#ifdef USE_CLEARCOAT
	uniform float clearcoat;
	uniform float clearcoatRoughness;
#endif
#ifdef USE_DIFFUSE_ROUGHNESS
	uniform float diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		uniform sampler2D diffuseRoughnessMap;
	#endif
#endif
#ifdef USE_DISPERSION
	uniform float dispersion;
#endif
#ifdef USE_RETROREFLECTION
	uniform float retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	uniform float iridescence;
	uniform float iridescenceIOR;
	uniform float iridescenceThicknessMinimum;
	uniform float iridescenceThicknessMaximum;
#endif
#ifdef USE_SHEEN
	uniform vec3 sheenColor;
	uniform float sheenRoughness;
	#ifdef USE_SHEEN_COLORMAP
		uniform sampler2D sheenColorMap;
	#endif
	#ifdef USE_SHEEN_ROUGHNESSMAP
		uniform sampler2D sheenRoughnessMap;
	#endif
#endif
#ifdef USE_ANISOTROPY
	uniform vec2 anisotropyVector;
	#ifdef USE_ANISOTROPYMAP
		uniform sampler2D anisotropyMap;
	#endif
#endif
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <iridescence_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_physical_pars_fragment>
#include <transmission_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <clearcoat_pars_fragment>
#include <iridescence_pars_fragment>
#include <roughnessmap_pars_fragment>
#include <metalnessmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <roughnessmap_fragment>
	#include <metalnessmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <clearcoat_normal_fragment_begin>
	#include <clearcoat_normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_physical_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 totalDiffuse = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse;
	vec3 totalSpecular = reflectedLight.directSpecular + reflectedLight.indirectSpecular;
	#include <transmission_fragment>
	vec3 outgoingLight = totalDiffuse + totalSpecular + totalEmissiveRadiance;
	#ifdef USE_SHEEN
 
		outgoingLight = outgoingLight + sheenSpecularDirect + sheenSpecularIndirect;
 
 	#endif
	#ifdef USE_CLEARCOAT
		float dotNVcc = saturate( dot( geometryClearcoatNormal, geometryViewDir ) );
		vec3 Fcc = F_Schlick( material.clearcoatF0, material.clearcoatF90, dotNVcc );
		outgoingLight = outgoingLight * ( 1.0 - material.clearcoat * Fcc ) + ( clearcoatSpecularDirect + clearcoatSpecularIndirect ) * material.clearcoat;
	#endif
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,NS=`#define TOON
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,DS=`#define TOON
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <gradientmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_toon_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_toon_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,US=`uniform float size;
uniform float scale;
#include <common>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
#ifdef USE_POINTS_UV
	varying vec2 vUv;
	uniform mat3 uvTransform;
#endif
void main() {
	#ifdef USE_POINTS_UV
		vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	#endif
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	gl_PointSize = size;
	#ifdef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) gl_PointSize *= ( scale / - mvPosition.z );
	#endif
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <fog_vertex>
}`,OS=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <color_pars_fragment>
#include <map_particle_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_particle_fragment>
	#include <color_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,FS=`#include <common>
#include <batching_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <shadowmap_pars_vertex>
void main() {
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,BS=`uniform vec3 color;
uniform float opacity;
#include <common>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <logdepthbuf_pars_fragment>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
void main() {
	#include <logdepthbuf_fragment>
	gl_FragColor = vec4( color, opacity * ( 1.0 - getShadowMask() ) );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,kS=`uniform float rotation;
uniform vec2 center;
#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	vec4 mvPosition = modelViewMatrix[ 3 ];
	vec2 scale = vec2( length( modelMatrix[ 0 ].xyz ), length( modelMatrix[ 1 ].xyz ) );
	#ifndef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) scale *= - mvPosition.z;
	#endif
	vec2 alignedPosition = ( position.xy - ( center - vec2( 0.5 ) ) ) * scale;
	vec2 rotatedPosition;
	rotatedPosition.x = cos( rotation ) * alignedPosition.x - sin( rotation ) * alignedPosition.y;
	rotatedPosition.y = sin( rotation ) * alignedPosition.x + cos( rotation ) * alignedPosition.y;
	mvPosition.xy += rotatedPosition;
	gl_Position = projectionMatrix * mvPosition;
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,zS=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,Gt={alphahash_fragment:lb,alphahash_pars_fragment:cb,alphamap_fragment:hb,alphamap_pars_fragment:ub,alphatest_fragment:fb,alphatest_pars_fragment:db,aomap_fragment:pb,aomap_pars_fragment:mb,batching_pars_vertex:gb,batching_vertex:_b,begin_vertex:xb,beginnormal_vertex:yb,bsdfs:vb,iridescence_fragment:bb,bumpmap_pars_fragment:Mb,clipping_planes_fragment:Sb,clipping_planes_pars_fragment:wb,clipping_planes_pars_vertex:Eb,clipping_planes_vertex:Ab,color_fragment:Tb,color_pars_fragment:Cb,color_pars_vertex:Rb,color_vertex:Pb,common:Ib,defaultnormal_vertex:Lb,displacementmap_pars_vertex:Nb,displacementmap_vertex:Db,emissivemap_fragment:Ub,emissivemap_pars_fragment:Ob,colorspace_fragment:Fb,colorspace_pars_fragment:Bb,envmap_fragment:kb,envmap_common_pars_fragment:zb,envmap_pars_fragment:Vb,envmap_pars_vertex:Gb,envmap_physical_pars_fragment:Qb,envmap_vertex:Hb,fog_vertex:Wb,fog_pars_vertex:Xb,fog_fragment:$b,fog_pars_fragment:qb,gradientmap_pars_fragment:Yb,lightmap_pars_fragment:Zb,lights_lambert_fragment:Jb,lights_lambert_pars_fragment:Kb,lights_pars_begin:jb,lights_toon_fragment:tM,lights_toon_pars_fragment:eM,lights_phong_fragment:nM,lights_phong_pars_fragment:iM,lights_physical_fragment:sM,lights_physical_pars_fragment:rM,lights_fragment_begin:oM,lights_fragment_maps:aM,lights_fragment_end:lM,lightprobes_pars_fragment:cM,logdepthbuf_fragment:hM,logdepthbuf_pars_fragment:uM,logdepthbuf_pars_vertex:fM,logdepthbuf_vertex:dM,map_fragment:pM,map_pars_fragment:mM,map_particle_fragment:gM,map_particle_pars_fragment:_M,metalnessmap_fragment:xM,metalnessmap_pars_fragment:yM,morphinstance_vertex:vM,morphcolor_vertex:bM,morphnormal_vertex:MM,morphtarget_pars_vertex:SM,morphtarget_vertex:wM,normal_fragment_begin:EM,normal_fragment_maps:AM,normal_pars_fragment:TM,normal_pars_vertex:CM,normal_vertex:RM,normalmap_pars_fragment:PM,clearcoat_normal_fragment_begin:IM,clearcoat_normal_fragment_maps:LM,clearcoat_pars_fragment:NM,iridescence_pars_fragment:DM,opaque_fragment:UM,packing:OM,premultiplied_alpha_fragment:FM,project_vertex:BM,dithering_fragment:kM,dithering_pars_fragment:zM,roughnessmap_fragment:VM,roughnessmap_pars_fragment:GM,shadowmap_pars_fragment:HM,shadowmap_pars_vertex:WM,shadowmap_vertex:XM,shadowmask_pars_fragment:$M,skinbase_vertex:qM,skinning_pars_vertex:YM,skinning_vertex:ZM,skinnormal_vertex:JM,specularmap_fragment:KM,specularmap_pars_fragment:jM,tonemapping_fragment:QM,tonemapping_pars_fragment:tS,transmission_fragment:eS,transmission_pars_fragment:nS,uv_pars_fragment:iS,uv_pars_vertex:sS,uv_vertex:rS,worldpos_vertex:oS,background_vert:aS,background_frag:lS,backgroundCube_vert:cS,backgroundCube_frag:hS,cube_vert:uS,cube_frag:fS,depth_vert:dS,depth_frag:pS,distance_vert:mS,distance_frag:gS,equirect_vert:_S,equirect_frag:xS,linedashed_vert:yS,linedashed_frag:vS,meshbasic_vert:bS,meshbasic_frag:MS,meshlambert_vert:SS,meshlambert_frag:wS,meshmatcap_vert:ES,meshmatcap_frag:AS,meshnormal_vert:TS,meshnormal_frag:CS,meshphong_vert:RS,meshphong_frag:PS,meshphysical_vert:IS,meshphysical_frag:LS,meshtoon_vert:NS,meshtoon_frag:DS,points_vert:US,points_frag:OS,shadow_vert:FS,shadow_frag:BS,sprite_vert:kS,sprite_frag:zS},_t={common:{diffuse:{value:new zt(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new Ut},alphaMap:{value:null},alphaMapTransform:{value:new Ut},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new Ut}},envmap:{envMap:{value:null},envMapRotation:{value:new Ut},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new Ut}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new Ut}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new Ut},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new Ut},normalScale:{value:new Ct(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new Ut},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new Ut}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new Ut}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new Ut}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new zt(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new zt(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new Ut},alphaTest:{value:0},uvTransform:{value:new Ut}},sprite:{diffuse:{value:new zt(16777215)},opacity:{value:1},center:{value:new Ct(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new Ut},alphaMap:{value:null},alphaMapTransform:{value:new Ut},alphaTest:{value:0}}},en={basic:{uniforms:qe([_t.common,_t.specularmap,_t.envmap,_t.aomap,_t.lightmap,_t.fog]),vertexShader:Gt.meshbasic_vert,fragmentShader:Gt.meshbasic_frag},lambert:{uniforms:qe([_t.common,_t.specularmap,_t.envmap,_t.aomap,_t.lightmap,_t.emissivemap,_t.bumpmap,_t.normalmap,_t.displacementmap,_t.fog,_t.lights,{emissive:{value:new zt(0)},envMapIntensity:{value:1}}]),vertexShader:Gt.meshlambert_vert,fragmentShader:Gt.meshlambert_frag},phong:{uniforms:qe([_t.common,_t.specularmap,_t.envmap,_t.aomap,_t.lightmap,_t.emissivemap,_t.bumpmap,_t.normalmap,_t.displacementmap,_t.fog,_t.lights,{emissive:{value:new zt(0)},specular:{value:new zt(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:Gt.meshphong_vert,fragmentShader:Gt.meshphong_frag},standard:{uniforms:qe([_t.common,_t.envmap,_t.aomap,_t.lightmap,_t.emissivemap,_t.bumpmap,_t.normalmap,_t.displacementmap,_t.roughnessmap,_t.metalnessmap,_t.fog,_t.lights,{emissive:{value:new zt(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:Gt.meshphysical_vert,fragmentShader:Gt.meshphysical_frag},toon:{uniforms:qe([_t.common,_t.aomap,_t.lightmap,_t.emissivemap,_t.bumpmap,_t.normalmap,_t.displacementmap,_t.gradientmap,_t.fog,_t.lights,{emissive:{value:new zt(0)}}]),vertexShader:Gt.meshtoon_vert,fragmentShader:Gt.meshtoon_frag},matcap:{uniforms:qe([_t.common,_t.bumpmap,_t.normalmap,_t.displacementmap,_t.fog,{matcap:{value:null}}]),vertexShader:Gt.meshmatcap_vert,fragmentShader:Gt.meshmatcap_frag},points:{uniforms:qe([_t.points,_t.fog]),vertexShader:Gt.points_vert,fragmentShader:Gt.points_frag},dashed:{uniforms:qe([_t.common,_t.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:Gt.linedashed_vert,fragmentShader:Gt.linedashed_frag},depth:{uniforms:qe([_t.common,_t.displacementmap]),vertexShader:Gt.depth_vert,fragmentShader:Gt.depth_frag},normal:{uniforms:qe([_t.common,_t.bumpmap,_t.normalmap,_t.displacementmap,{opacity:{value:1}}]),vertexShader:Gt.meshnormal_vert,fragmentShader:Gt.meshnormal_frag},sprite:{uniforms:qe([_t.sprite,_t.fog]),vertexShader:Gt.sprite_vert,fragmentShader:Gt.sprite_frag},background:{uniforms:{uvTransform:{value:new Ut},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:Gt.background_vert,fragmentShader:Gt.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new Ut}},vertexShader:Gt.backgroundCube_vert,fragmentShader:Gt.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:Gt.cube_vert,fragmentShader:Gt.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:Gt.equirect_vert,fragmentShader:Gt.equirect_frag},distance:{uniforms:qe([_t.common,_t.displacementmap,{referencePosition:{value:new N},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:Gt.distance_vert,fragmentShader:Gt.distance_frag},shadow:{uniforms:qe([_t.lights,_t.fog,{color:{value:new zt(0)},opacity:{value:1}}]),vertexShader:Gt.shadow_vert,fragmentShader:Gt.shadow_frag}};en.physical={uniforms:qe([en.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new Ut},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new Ut},clearcoatNormalScale:{value:new Ct(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new Ut},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new Ut},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new Ut},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new Ut},sheen:{value:0},sheenColor:{value:new zt(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new Ut},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new Ut},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new Ut},transmissionSamplerSize:{value:new Ct},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new Ut},attenuationDistance:{value:0},attenuationColor:{value:new zt(0)},specularColor:{value:new zt(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new Ut},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new Ut},anisotropyVector:{value:new Ct},anisotropyMap:{value:null},anisotropyMapTransform:{value:new Ut}}]),vertexShader:Gt.meshphysical_vert,fragmentShader:Gt.meshphysical_frag};var kc={r:0,b:0,g:0},VS=new se,l0=new Ut;l0.set(-1,0,0,0,1,0,0,0,1);function GS(n,t,e,i,s,r){let o=new zt(0),a=s===!0?0:1,c,l,h=null,u=0,f=null;function d(y){let b=y.isScene===!0?y.background:null;if(b&&b.isTexture){let v=y.backgroundBlurriness>0;b=t.get(b,v)}return b}function g(y){let b=!1,v=d(y);v===null?m(o,a):v&&v.isColor&&(m(v,1),b=!0);let A=n.xr.getEnvironmentBlendMode();A==="additive"?e.buffers.color.setClear(0,0,0,1,r):A==="alpha-blend"&&e.buffers.color.setClear(0,0,0,0,r),(n.autoClear||b)&&(e.buffers.depth.setTest(!0),e.buffers.depth.setMask(!0),e.buffers.color.setMask(!0),n.clear(n.autoClearColor,n.autoClearDepth,n.autoClearStencil))}function _(y,b){let v=d(b);v&&v.isCubeTexture?(l===void 0&&(l=new _e(new Si(1,1,1),new Mn({name:"BackgroundCubeMaterial",uniforms:Es(en.backgroundCube.uniforms),vertexShader:en.backgroundCube.vertexShader,fragmentShader:en.backgroundCube.fragmentShader,side:De,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),l.geometry.deleteAttribute("uv"),l.onBeforeRender=function(A,E,x){this.matrixWorld.copyPosition(x.matrixWorld)},Object.defineProperty(l.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),i.update(l)),l.material.uniforms.envMap.value=v,l.material.uniforms.backgroundBlurriness.value=b.backgroundBlurriness,l.material.uniforms.backgroundIntensity.value=b.backgroundIntensity,l.material.uniforms.backgroundRotation.value.setFromMatrix4(VS.makeRotationFromEuler(b.backgroundRotation)).transpose(),v.isRenderTargetTexture===!1&&l.material.uniforms.backgroundRotation.value.premultiply(l0),l.material.toneMapped=Yt.getTransfer(v.colorSpace)!==te,(h!==v||u!==v.version||f!==n.toneMapping)&&(l.material.needsUpdate=!0,h=v,u=v.version,f=n.toneMapping),l.layers.enableAll(),y.unshift(l,l.geometry,l.material,0,0,null)):v&&v.isTexture&&(c===void 0&&(c=new _e(new _s(2,2),new Mn({name:"BackgroundMaterial",uniforms:Es(en.background.uniforms),vertexShader:en.background.vertexShader,fragmentShader:en.background.fragmentShader,side:$i,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),Object.defineProperty(c.material,"map",{get:function(){return this.uniforms.t2D.value}}),i.update(c)),c.material.uniforms.t2D.value=v,c.material.uniforms.backgroundIntensity.value=b.backgroundIntensity,c.material.toneMapped=Yt.getTransfer(v.colorSpace)!==te,v.matrixAutoUpdate===!0&&v.updateMatrix(),c.material.uniforms.uvTransform.value.copy(v.matrix),(h!==v||u!==v.version||f!==n.toneMapping)&&(c.material.needsUpdate=!0,h=v,u=v.version,f=n.toneMapping),c.layers.enableAll(),y.unshift(c,c.geometry,c.material,0,0,null))}function m(y,b){y.getRGB(kc,pf(n)),e.buffers.color.setClear(kc.r,kc.g,kc.b,b,r)}function p(){l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0),c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0)}return{getClearColor:function(){return o},setClearColor:function(y,b=1){o.set(y),a=b,m(o,a)},getClearAlpha:function(){return a},setClearAlpha:function(y){a=y,m(o,a)},render:g,addToRenderList:_,dispose:p}}function HS(n,t){let e=n.getParameter(n.MAX_VERTEX_ATTRIBS),i={},s=f(null),r=s,o=!1;function a(L,I,z,C,H){let q=!1,V=u(L,C,z,I);r!==V&&(r=V,l(r.object)),q=d(L,C,z,H),q&&g(L,C,z,H),H!==null&&t.update(H,n.ELEMENT_ARRAY_BUFFER),(q||o)&&(o=!1,v(L,I,z,C),H!==null&&n.bindBuffer(n.ELEMENT_ARRAY_BUFFER,t.get(H).buffer))}function c(){return n.createVertexArray()}function l(L){return n.bindVertexArray(L)}function h(L){return n.deleteVertexArray(L)}function u(L,I,z,C){let H=C.wireframe===!0,q=i[I.id];q===void 0&&(q={},i[I.id]=q);let V=L.isInstancedMesh===!0?L.id:0,j=q[V];j===void 0&&(j={},q[V]=j);let X=j[z.id];X===void 0&&(X={},j[z.id]=X);let Y=X[H];return Y===void 0&&(Y=f(c()),X[H]=Y),Y}function f(L){let I=[],z=[],C=[];for(let H=0;H<e;H++)I[H]=0,z[H]=0,C[H]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:I,enabledAttributes:z,attributeDivisors:C,object:L,attributes:{},index:null}}function d(L,I,z,C){let H=r.attributes,q=I.attributes,V=0,j=z.getAttributes();for(let X in j)if(j[X].location>=0){let st=H[X],O=q[X];if(O===void 0&&(X==="instanceMatrix"&&L.instanceMatrix&&(O=L.instanceMatrix),X==="instanceColor"&&L.instanceColor&&(O=L.instanceColor)),st===void 0||st.attribute!==O||O&&st.data!==O.data)return!0;V++}return r.attributesNum!==V||r.index!==C}function g(L,I,z,C){let H={},q=I.attributes,V=0,j=z.getAttributes();for(let X in j)if(j[X].location>=0){let st=q[X];st===void 0&&(X==="instanceMatrix"&&L.instanceMatrix&&(st=L.instanceMatrix),X==="instanceColor"&&L.instanceColor&&(st=L.instanceColor));let O={};O.attribute=st,st&&st.data&&(O.data=st.data),H[X]=O,V++}r.attributes=H,r.attributesNum=V,r.index=C}function _(){let L=r.newAttributes;for(let I=0,z=L.length;I<z;I++)L[I]=0}function m(L){p(L,0)}function p(L,I){let z=r.newAttributes,C=r.enabledAttributes,H=r.attributeDivisors;z[L]=1,C[L]===0&&(n.enableVertexAttribArray(L),C[L]=1),H[L]!==I&&(n.vertexAttribDivisor(L,I),H[L]=I)}function y(){let L=r.newAttributes,I=r.enabledAttributes;for(let z=0,C=I.length;z<C;z++)I[z]!==L[z]&&(n.disableVertexAttribArray(z),I[z]=0)}function b(L,I,z,C,H,q,V){V===!0?n.vertexAttribIPointer(L,I,z,H,q):n.vertexAttribPointer(L,I,z,C,H,q)}function v(L,I,z,C){_();let H=C.attributes,q=z.getAttributes(),V=I.defaultAttributeValues;for(let j in q){let X=q[j];if(X.location>=0){let Y=H[j];if(Y===void 0&&(j==="instanceMatrix"&&L.instanceMatrix&&(Y=L.instanceMatrix),j==="instanceColor"&&L.instanceColor&&(Y=L.instanceColor)),Y!==void 0){let st=Y.normalized,O=Y.itemSize,Z=t.get(Y);if(Z===void 0)continue;let B=Z.buffer,et=Z.type,it=Z.bytesPerElement,ot=et===n.INT||et===n.UNSIGNED_INT||Y.gpuType===ec;if(Y.isInterleavedBufferAttribute){let rt=Y.data,Mt=rt.isInterleavedBuffer===!0?rt.stride:rt.itemSize,Wt=Y.offset;if(rt.isInstancedInterleavedBuffer||rt.isInstancedBufferAttribute){for(let At=0;At<X.locationSize;At++)p(X.location+At,rt.meshPerAttribute);L.isInstancedMesh!==!0&&C._maxInstanceCount===void 0&&(C._maxInstanceCount=rt.meshPerAttribute*rt.count)}else for(let At=0;At<X.locationSize;At++)m(X.location+At);n.bindBuffer(n.ARRAY_BUFFER,B);for(let At=0;At<X.locationSize;At++)b(X.location+At,O/X.locationSize,et,st,Mt*it,(Wt+O/X.locationSize*At)*it,ot)}else{if(Y.isInstancedBufferAttribute){for(let rt=0;rt<X.locationSize;rt++)p(X.location+rt,Y.meshPerAttribute);L.isInstancedMesh!==!0&&C._maxInstanceCount===void 0&&(C._maxInstanceCount=Y.meshPerAttribute*Y.count)}else for(let rt=0;rt<X.locationSize;rt++)m(X.location+rt);n.bindBuffer(n.ARRAY_BUFFER,B);for(let rt=0;rt<X.locationSize;rt++)b(X.location+rt,O/X.locationSize,et,st,O*it,O/X.locationSize*rt*it,ot)}}else if(V!==void 0){let st=V[j];if(st!==void 0)switch(st.length){case 2:n.vertexAttrib2fv(X.location,st);break;case 3:n.vertexAttrib3fv(X.location,st);break;case 4:n.vertexAttrib4fv(X.location,st);break;default:n.vertexAttrib1fv(X.location,st)}}}}y()}function A(){D();for(let L in i){let I=i[L];for(let z in I){let C=I[z];for(let H in C){let q=C[H];for(let V in q)h(q[V].object),delete q[V];delete C[H]}}delete i[L]}}function E(L){if(i[L.id]===void 0)return;let I=i[L.id];for(let z in I){let C=I[z];for(let H in C){let q=C[H];for(let V in q)h(q[V].object),delete q[V];delete C[H]}}delete i[L.id]}function x(L){for(let I in i){let z=i[I];for(let C in z){let H=z[C];if(H[L.id]===void 0)continue;let q=H[L.id];for(let V in q)h(q[V].object),delete q[V];delete H[L.id]}}}function w(L){for(let I in i){let z=i[I],C=L.isInstancedMesh===!0?L.id:0,H=z[C];if(H!==void 0){for(let q in H){let V=H[q];for(let j in V)h(V[j].object),delete V[j];delete H[q]}delete z[C],Object.keys(z).length===0&&delete i[I]}}}function D(){R(),o=!0,r!==s&&(r=s,l(r.object))}function R(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:a,reset:D,resetDefaultState:R,dispose:A,releaseStatesOfGeometry:E,releaseStatesOfObject:w,releaseStatesOfProgram:x,initAttributes:_,enableAttribute:m,disableUnusedAttributes:y}}function WS(n,t,e){let i;function s(c){i=c}function r(c,l){n.drawArrays(i,c,l),e.update(l,i,1)}function o(c,l,h){h!==0&&(n.drawArraysInstanced(i,c,l,h),e.update(l,i,h))}function a(c,l,h){if(h===0)return;t.get("WEBGL_multi_draw").multiDrawArraysWEBGL(i,c,0,l,0,h);let f=0;for(let d=0;d<h;d++)f+=l[d];e.update(f,i,1)}this.setMode=s,this.render=r,this.renderInstances=o,this.renderMultiDraw=a}function XS(n,t,e,i){let s;function r(){if(s!==void 0)return s;if(t.has("EXT_texture_filter_anisotropic")===!0){let x=t.get("EXT_texture_filter_anisotropic");s=n.getParameter(x.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function o(x){return!(x!==zn&&i.convert(x)!==n.getParameter(n.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(x){let w=x===kn&&(t.has("EXT_color_buffer_half_float")||t.has("EXT_color_buffer_float"));return!(x!==an&&x!==Bn&&!w&&i.convert(x)!==n.getParameter(n.IMPLEMENTATION_COLOR_READ_TYPE))}function c(x){if(x==="highp"){if(n.getShaderPrecisionFormat(n.VERTEX_SHADER,n.HIGH_FLOAT).precision>0&&n.getShaderPrecisionFormat(n.FRAGMENT_SHADER,n.HIGH_FLOAT).precision>0)return"highp";x="mediump"}return x==="mediump"&&n.getShaderPrecisionFormat(n.VERTEX_SHADER,n.MEDIUM_FLOAT).precision>0&&n.getShaderPrecisionFormat(n.FRAGMENT_SHADER,n.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let l=e.precision!==void 0?e.precision:"highp",h=c(l);h!==l&&(It("WebGLRenderer:",l,"not supported, using",h,"instead."),l=h);let u=e.reversedDepthBuffer===!0&&t.has("EXT_clip_control"),f=e.logarithmicDepthBuffer===!0&&u===!1;e.reversedDepthBuffer===!0&&u===!1&&It("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),e.logarithmicDepthBuffer===!0&&u===!0&&It("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let d=n.getParameter(n.MAX_TEXTURE_IMAGE_UNITS),g=n.getParameter(n.MAX_VERTEX_TEXTURE_IMAGE_UNITS),_=n.getParameter(n.MAX_TEXTURE_SIZE),m=n.getParameter(n.MAX_CUBE_MAP_TEXTURE_SIZE),p=n.getParameter(n.MAX_VERTEX_ATTRIBS),y=n.getParameter(n.MAX_VERTEX_UNIFORM_VECTORS),b=n.getParameter(n.MAX_VARYING_VECTORS),v=n.getParameter(n.MAX_FRAGMENT_UNIFORM_VECTORS),A=n.getParameter(n.MAX_SAMPLES),E=n.getParameter(n.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:c,textureFormatReadable:o,textureTypeReadable:a,precision:l,logarithmicDepthBuffer:f,reversedDepthBuffer:u,maxTextures:d,maxVertexTextures:g,maxTextureSize:_,maxCubemapSize:m,maxAttributes:p,maxVertexUniforms:y,maxVaryings:b,maxFragmentUniforms:v,maxSamples:A,samples:E}}function $S(n){let t=this,e=null,i=0,s=!1,r=!1,o=new Ke,a=new Ut,c={value:null,needsUpdate:!1};this.uniform=c,this.numPlanes=0,this.numIntersection=0,this.init=function(u,f){let d=u.length!==0||f||i!==0||s;return s=f,i=u.length,d},this.beginShadows=function(){r=!0,h(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(u,f){e=h(u,f,0)},this.setState=function(u,f,d){let g=u.clippingPlanes,_=u.clipIntersection,m=u.clipShadows,p=n.get(u);if(!s||g===null||g.length===0||r&&!m)r?h(null):l();else{let y=r?0:i,b=y*4,v=p.clippingState||null;c.value=v,v=h(g,f,b,d);for(let A=0;A!==b;++A)v[A]=e[A];p.clippingState=v,this.numIntersection=_?this.numPlanes:0,this.numPlanes+=y}};function l(){c.value!==e&&(c.value=e,c.needsUpdate=i>0),t.numPlanes=i,t.numIntersection=0}function h(u,f,d,g){let _=u!==null?u.length:0,m=null;if(_!==0){if(m=c.value,g!==!0||m===null){let p=d+_*4,y=f.matrixWorldInverse;a.getNormalMatrix(y),(m===null||m.length<p)&&(m=new Float32Array(p));for(let b=0,v=d;b!==_;++b,v+=4)o.copy(u[b]).applyMatrix4(y,a),o.normal.toArray(m,v),m[v+3]=o.constant}c.value=m,c.needsUpdate=!0}return t.numPlanes=_,t.numIntersection=0,m}}var Yo=class extends fn{constructor(t=1,e={}){super(t,t,e),this.isWebGLCubeRenderTarget=!0;let i={width:t,height:t,depth:1},s=[i,i,i,i,i,i];this.texture=new yo(s),this._setTextureOptions(e),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(t,e){this.texture.type=e.type,this.texture.colorSpace=e.colorSpace,this.texture.generateMipmaps=e.generateMipmaps,this.texture.minFilter=e.minFilter,this.texture.magFilter=e.magFilter;let i={uniforms:{tEquirect:{value:null}},vertexShader:`

				varying vec3 vWorldDirection;

				vec3 transformDirection( in vec3 dir, in mat4 matrix ) {

					return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );

				}

				void main() {

					vWorldDirection = transformDirection( position, modelMatrix );

					#include <begin_vertex>
					#include <project_vertex>

				}
			`,fragmentShader:`

				uniform sampler2D tEquirect;

				varying vec3 vWorldDirection;

				#include <common>

				void main() {

					vec3 direction = normalize( vWorldDirection );

					vec2 sampleUV = equirectUv( direction );

					gl_FragColor = texture2D( tEquirect, sampleUV );

				}
			`},s=new Si(5,5,5),r=new Mn({name:"CubemapFromEquirect",uniforms:Es(i.uniforms),vertexShader:i.vertexShader,fragmentShader:i.fragmentShader,side:De,blending:bs});r.uniforms.tEquirect.value=e;let o=new _e(s,r),a=e.minFilter;return e.minFilter===wi&&(e.minFilter=Qe),new Sr(1,10,this).update(t,o),e.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(t,e=!0,i=!0,s=!0){let r=t.getRenderTarget();for(let o=0;o<6;o++)t.setRenderTarget(this,o),t.clear(e,i,s);t.setRenderTarget(r)}},zg=256,qS=3,YS=20,c0=256,h0=16,ZS=3,JS=new N,KS=new zt,Vc=class n{constructor(t){this._renderer=t,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new Sr(1,10,null),this._boxMesh=new _e(new Si(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(t,e=0,i=.1,s=100,r={}){let{size:o=256,position:a=JS}=r,c=this._renderer;this._setSize(o);let l=this._allocateTarget(),h=this._getSourceTarget(!0);e>0&&(h.texture.mipmapsAutoUpdate=!1);let u=c.autoClear,f=c.autoClearColor,d=c.autoClearDepth,g=c.autoClearStencil,_=t.background;c.autoClear=!0,c.autoClearColor=!0,c.autoClearDepth=!0,c.autoClearStencil=!0,_===null&&(t.background=c.getClearColor(KS));let m=new Sr(i,s,h);return m.position.copy(a),m.update(c,t),c.autoClear=u,c.autoClearColor=f,c.autoClearDepth=d,c.autoClearStencil=g,t.background=_,e>0&&(h.texture.mipmapsAutoUpdate=!0,this._blur(l,e)),this._applyPMREM(l),l}fromEquirectangular(t,e=null){return this._fromTexture(t,e)}fromCubemap(t,e=null){return this._fromTexture(t,e)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=Hg(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=Gg(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(t,e){return e>0?1-Math.sqrt(1-t/e):0}_setSize(t){this._cubeSize=Math.max(zg,uf(t))}_fromTexture(t,e){t.mapping===Ss||t.mapping===Tr?this._setSize(t.image.length===0?zg:t.image[0].width||t.image[0].image.width):this._setSize(t.image.width/4);let i=e||this._allocateTarget();return this._textureToCubemap(t),this._applyPMREM(i),i}_allocateTarget(){let t=this._cubeSize,e=Vg(t,!1,!1),i=Math.log2(t)-qS;for(let s=0;s<=i;s++)e.texture.mipmaps.push({width:t>>s,height:t>>s});return e.texture.name="PMREM",e.texture.isPMREMTexture=!0,e}_getSourceTarget(t=!1){let e=this._cubeSize,i=this._sourceTarget;return(i===null||i.width!==e||t&&i.depthBuffer===!1)&&(i!==null&&i.dispose(),this._sourceTarget=Vg(e,!0,t)),this._sourceTarget}_compileMaterial(t){this._boxMesh.material=t,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(t,e,i){let s=this._boxMesh,r=this._cubeCamera;s.material=i,r.renderTarget=t,r.activeMipmapLevel=e;let o=t.width>>e;t.viewport.set(0,0,o,o),r.update(this._renderer,s),t.viewport.set(0,0,t.width,t.height)}_textureToCubemap(t){let e;t.mapping===Ss||t.mapping===Tr?(this._cubemapMaterial===null&&(this._cubemapMaterial=Hg()),e=this._cubemapMaterial,e.uniforms.flipEnvMap.value=t.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=Gg()),e=this._equirectMaterial),e.uniforms.envMap.value=t,this._renderCube(this._getSourceTarget(),0,e)}_applyPMREM(t){this._ggxMaterial===null&&(this._ggxMaterial=jS(),this._integrationMaterial=QS());let e=this._cubeSize,i=t.texture.mipmaps.length-1,s=this._ggxMaterial.uniforms;s.envMap.value=this._sourceTarget.texture;let r=this._integrationMaterial.uniforms;r.envMap.value=this._sourceTarget.texture,r.sourceLod.value=Math.log2(e/h0);for(let o=0;o<=i;o++){let a=n.lodToRoughness(o,i);if(o>i-ZS)r.roughness.value=a,this._renderCube(t,o,this._integrationMaterial);else{let c=a>0?Math.log2(e)+.5*Math.log2(6/(c0*Math.pow(a,4)))+.5:0;s.roughness.value=a,s.lodBias.value=c,this._renderCube(t,o,this._ggxMaterial)}}}_blur(t,e){this._blurMaterial===null&&(this._blurMaterial=tw());let i=this._blurMaterial,s=i.uniforms,r=this._sourceTarget;s.sigma.value=Math.min(e,Math.PI)/Math.SQRT2,s.envMap.value=r.texture,this._renderCube(t,0,i),s.envMap.value=t.texture,this._renderCube(r,0,i)}};function Vg(n,t,e){return new Yo(n,{minFilter:wi,generateMipmaps:t,type:kn,colorSpace:ho,depthBuffer:e})}function Zo(n,t,e){return new Mn({name:n,uniforms:t,vertexShader:Gt.cube_vert,fragmentShader:e,side:De,blending:bs,depthTest:!1,depthWrite:!1})}function jS(){return Zo("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${c0}u

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float lodBias;

		#include <common>

		// Van der Corput radical inverse
		float radicalInverse_VdC( uint bits ) {

			bits = ( bits << 16u ) | ( bits >> 16u );
			bits = ( ( bits & 0x55555555u ) << 1u ) | ( ( bits & 0xAAAAAAAAu ) >> 1u );
			bits = ( ( bits & 0x33333333u ) << 2u ) | ( ( bits & 0xCCCCCCCCu ) >> 2u );
			bits = ( ( bits & 0x0F0F0F0Fu ) << 4u ) | ( ( bits & 0xF0F0F0F0u ) >> 4u );
			bits = ( ( bits & 0x00FF00FFu ) << 8u ) | ( ( bits & 0xFF00FF00u ) >> 8u );
			return float( bits ) * 2.3283064365386963e-10; // / 0x100000000

		}

		// Hammersley sequence
		vec2 hammersley( uint i, uint N ) {

			return vec2( float( i ) / float( N ), radicalInverse_VdC( i ) );

		}

		void main() {

			vec3 N = normalize( vWorldDirection );

			// For very low roughness, just sample the environment directly
			if ( roughness < 0.001 ) {

				gl_FragColor = vec4( textureLod( envMap, N, 0.0 ).rgb, 1.0 );
				return;

			}

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			// Tangent space basis for VNDF sampling
			vec3 up = abs( N.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, N ) );
			vec3 bitangent = cross( N, tangent );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			for ( uint i = 0u; i < GGX_SAMPLES; i ++ ) {

				vec2 Xi = hammersley( i, GGX_SAMPLES );

				// With V = N, sample the reflected direction directly.
				float invQ = 1.0 / ( 1.0 - Xi.x + alpha2 * Xi.x );
				float NdotL = ( 1.0 - Xi.x - alpha2 * Xi.x ) * invQ;

				if ( NdotL > 0.0 ) {

					float phi = 2.0 * PI * Xi.y;
					float sinTheta = 2.0 * alpha * sqrt( Xi.x * ( 1.0 - Xi.x ) ) * invQ;
					vec3 L = N * NdotL + ( tangent * cos( phi ) + bitangent * sin( phi ) ) * sinTheta;

					// Match the source mip to the sample's solid angle. The terms
					// independent of the sample are precomputed in lodBias.
					float d = alpha2 * invQ;
					float lod = max( log2( d ) + lodBias, 0.0 );

					// Weight by NdotL for the split-sum approximation
					prefilteredColor += textureLod( envMap, L, lod ).rgb * NdotL;
					totalWeight += NdotL;

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function QS(){return Zo("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:h0}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float sourceLod;
		uniform int sourceSize;

		void main() {

			vec3 N = normalize( vWorldDirection );

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			float texelSize = 2.0 / float( sourceSize );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			// Pair opposite texels: only the one in N's hemisphere contributes.
			for ( int face = 0; face < 3; face ++ ) {

				for ( int y = 0; y < sourceSize; y ++ ) {

					for ( int x = 0; x < sourceSize; x ++ ) {

						vec2 uv = ( vec2( x, y ) + 0.5 ) * texelSize - 1.0;
						vec3 texelDirection = face == 0 ? vec3( 1.0, uv ) : ( face == 1 ? vec3( uv.x, 1.0, uv.y ) : vec3( uv, 1.0 ) );

						float invDistance = inversesqrt( 1.0 + dot( uv, uv ) );
						float NdotL = dot( N, texelDirection );
						texelDirection *= NdotL < 0.0 ? - 1.0 : 1.0;
						NdotL = abs( NdotL ) * invDistance;

						// With V = N, NdotH squared is ( 1 + NdotL ) / 2. Common factors
						// in the GGX distribution and texel solid angle cancel when normalized.
						float d = 1.0 + alpha2 + ( alpha2 - 1.0 ) * NdotL;
						float weight = NdotL * invDistance * invDistance * invDistance / ( d * d );

						prefilteredColor += textureLod( envMap, texelDirection, sourceLod ).rgb * weight;
						totalWeight += weight;

					}

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function tw(){return Zo("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${YS}
		#define GOLDEN_ANGLE 2.39996322973

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float sigma;

		#include <common>

		void main() {

			vec3 outputDirection = normalize( vWorldDirection );

			vec3 up = abs( outputDirection.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, outputDirection ) );
			vec3 bitangent = cross( outputDirection, tangent );

			// Truncate the kernel at three standard deviations or at the antipode.
			float thetaMax = min( 3.0 * sigma, PI );
			float truncation = 1.0 - exp( - 0.5 * thetaMax * thetaMax / ( sigma * sigma ) );

			vec3 accumColor = vec3( 0.0 );
			float accumWeight = 0.0;

			for ( int i = 0; i < SAMPLES; i ++ ) {

				// Stratified inverse-CDF sampling of the Gaussian, placed on a golden-angle spiral.
				float stratum = ( float( i ) + 0.5 ) / float( SAMPLES );
				float theta = sigma * sqrt( - 2.0 * log( 1.0 - stratum * truncation ) );
				float phi = float( i ) * GOLDEN_ANGLE;

				vec3 offset = cos( phi ) * tangent + sin( phi ) * bitangent;
				vec3 sampleDirection = cos( theta ) * outputDirection + sin( theta ) * offset;

				// Correct the planar sample density to solid angle.
				float weight = sin( theta ) / theta;

				accumColor += weight * textureLod( envMap, sampleDirection, 0.0 ).rgb;
				accumWeight += weight;

			}

			gl_FragColor = vec4( accumColor / accumWeight, 1.0 );

		}
	`)}function Gg(){return Zo("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

		varying vec3 vWorldDirection;

		uniform sampler2D envMap;

		#include <common>

		void main() {

			// Average four subpixel samples to preserve small, bright features.
			vec3 direction = normalize( vWorldDirection );
			vec3 dx = dFdx( direction ) * 0.25;
			vec3 dy = dFdy( direction ) * 0.25;

			vec3 color = textureLod( envMap, equirectUv( normalize( direction - dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction - dx + dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx + dy ) ), 0.0 ).rgb;
			gl_FragColor = vec4( color * 0.25, 1.0 );

		}
	`)}function Hg(){return Zo("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function ew(n){let t=new WeakMap,e=new WeakMap,i=null;function s(f,d=!1){return f==null?null:d?o(f):r(f)}function r(f){if(f&&f.isTexture){let d=f.mapping;if(d===jl||d===Ql)if(t.has(f)){let g=t.get(f).texture;return a(g,f.mapping)}else{let g=f.image;if(g&&g.height>0){let _=new Yo(g.height);return _.fromEquirectangularTexture(n,f),t.set(f,_),f.addEventListener("dispose",l),a(_.texture,f.mapping)}else return null}}return f}function o(f){if(f&&f.isTexture&&f.isPMREMTexture!==!0){let d=f.mapping,g=d===jl||d===Ql,_=d===Ss||d===Tr;if(g||_){let m=e.get(f),p=m!==void 0?m.texture.pmremVersion:0;if(f.isRenderTargetTexture&&f.pmremVersion!==p)return i===null&&(i=new Vc(n)),m=g?i.fromEquirectangular(f,m):i.fromCubemap(f,m),m.texture.pmremVersion=f.pmremVersion,e.set(f,m),m.texture;if(m!==void 0)return m.texture;{let y=f.image;return g&&y&&y.height>0||_&&y&&c(y)?(i===null&&(i=new Vc(n)),m=g?i.fromEquirectangular(f):i.fromCubemap(f),m.texture.pmremVersion=f.pmremVersion,e.set(f,m),f.addEventListener("dispose",h),m.texture):null}}}return f}function a(f,d){return d===jl?f.mapping=Ss:d===Ql&&(f.mapping=Tr),f}function c(f){let d=0,g=6;for(let _=0;_<g;_++)f[_]!==void 0&&d++;return d===g}function l(f){let d=f.target;d.removeEventListener("dispose",l);let g=t.get(d);g!==void 0&&(t.delete(d),g.dispose())}function h(f){let d=f.target;d.removeEventListener("dispose",h);let g=e.get(d);g!==void 0&&(e.delete(d),g.dispose())}function u(){t=new WeakMap,e=new WeakMap,i!==null&&(i.dispose(),i=null)}return{get:s,dispose:u}}function nw(n){let t={};function e(i){if(t[i]!==void 0)return t[i];let s=n.getExtension(i);return t[i]=s,s}return{has:function(i){return e(i)!==null},init:function(){e("EXT_color_buffer_float"),e("WEBGL_clip_cull_distance"),e("OES_texture_float_linear"),e("EXT_color_buffer_half_float"),e("WEBGL_multisampled_render_to_texture"),e("WEBGL_render_shared_exponent")},get:function(i){let s=e(i);return s===null&&ao("WebGLRenderer: "+i+" extension not supported."),s}}}function iw(n,t,e,i){let s={},r=new WeakMap,o=new FinalizationRegistry(g=>delete s[g]);function a(g){c(g.target)}function c(g){g.index!==null&&t.remove(g.index);for(let m in g.attributes)t.remove(g.attributes[m]);g.removeEventListener("dispose",a),delete s[g.id],o.unregister(g);let _=r.get(g);_&&(t.remove(_),r.delete(g)),i.releaseStatesOfGeometry(g),g.isInstancedBufferGeometry===!0&&delete g._maxInstanceCount,e.memory.geometries--}function l(g,_){return s[_.id]!==void 0||(_.addEventListener("dispose",a),s[_.id]=new WeakRef(_),o.register(_,_.id,_),e.memory.geometries++),_}function h(g){let _=g.attributes;for(let m in _)t.update(_[m],n.ARRAY_BUFFER)}function u(g){let _=g.index,m=g.attributes.position,p=0;if(m===void 0)return;let y=_!==null?_.array.length:m.array.length/3-1,b=m.count>=65535?xo:_o,v=new b(Math.ceil(y/3)*6,1),A=v.array;if(_!==null){let x=_.array;p=_.version;for(let w=0,D=0;w<y;w+=3){let R=x[w+0],L=x[w+1],I=x[w+2];A[D++]=R,A[D++]=L,A[D++]=L,A[D++]=I,A[D++]=I,A[D++]=R}}else{p=m.version;for(let x=0,w=0;x<y;x+=3){let D=x+0,R=x+1,L=x+2;A[w++]=D,A[w++]=R,A[w++]=R,A[w++]=L,A[w++]=L,A[w++]=D}}v.version=p;let E=r.get(g);E&&t.remove(E),r.set(g,v)}function f(g){let _=r.get(g);if(_){let m=g.index;m!==null&&_.version<m.version&&u(g)}else u(g);return r.get(g)}function d(){for(let g in s){let _=s[g].deref();_!==void 0&&c(_)}}return{get:l,update:h,getWireframeAttribute:f,dispose:d}}function sw(n,t,e){let i;function s(u){i=u}let r,o;function a(u){r=u.type,o=u.bytesPerElement}function c(u,f){n.drawElements(i,f,r,u*o),e.update(f,i,1)}function l(u,f,d){d!==0&&(n.drawElementsInstanced(i,f,r,u*o,d),e.update(f,i,d))}function h(u,f,d){if(d===0)return;t.get("WEBGL_multi_draw").multiDrawElementsWEBGL(i,f,0,r,u,0,d);let _=0;for(let m=0;m<d;m++)_+=f[m];e.update(_,i,1)}this.setMode=s,this.setIndex=a,this.render=c,this.renderInstances=l,this.renderMultiDraw=h}function rw(n){let t={geometries:0,textures:0},e={frame:0,calls:0,triangles:0,points:0,lines:0};function i(r,o,a){switch(e.calls++,o){case n.TRIANGLES:e.triangles+=a*(r/3);break;case n.LINES:e.lines+=a*(r/2);break;case n.LINE_STRIP:e.lines+=a*(r-1);break;case n.LINE_LOOP:e.lines+=a*r;break;case n.POINTS:e.points+=a*r;break;default:Nt("WebGLInfo: Unknown draw mode:",o);break}}function s(){e.calls=0,e.triangles=0,e.points=0,e.lines=0}return{memory:t,render:e,programs:null,autoReset:!0,reset:s,update:i}}function ow(n,t,e){let i=new WeakMap,s=new ee;function r(o,a,c){let l=o.morphTargetInfluences,h=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,u=h!==void 0?h.length:0,f=i.get(a);if(f===void 0||f.count!==u){let D=function(){x.dispose(),i.delete(a),a.removeEventListener("dispose",D)};f!==void 0&&f.texture.dispose();let d=a.morphAttributes.position!==void 0,g=a.morphAttributes.normal!==void 0,_=a.morphAttributes.color!==void 0,m=a.morphAttributes.position||[],p=a.morphAttributes.normal||[],y=a.morphAttributes.color||[],b=0;d===!0&&(b=1),g===!0&&(b=2),_===!0&&(b=3);let v=a.attributes.position.count*b,A=1;v>t.maxTextureSize&&(A=Math.ceil(v/t.maxTextureSize),v=t.maxTextureSize);let E=new Float32Array(v*A*4*u),x=new mo(E,v,A,u);x.type=Bn,x.needsUpdate=!0;let w=b*4;for(let R=0;R<u;R++){let L=m[R],I=p[R],z=y[R],C=v*A*4*R;for(let H=0;H<L.count;H++){let q=H*w;d===!0&&(s.fromBufferAttribute(L,H),E[C+q+0]=s.x,E[C+q+1]=s.y,E[C+q+2]=s.z,E[C+q+3]=0),g===!0&&(s.fromBufferAttribute(I,H),E[C+q+4]=s.x,E[C+q+5]=s.y,E[C+q+6]=s.z,E[C+q+7]=0),_===!0&&(s.fromBufferAttribute(z,H),E[C+q+8]=s.x,E[C+q+9]=s.y,E[C+q+10]=s.z,E[C+q+11]=z.itemSize===4?s.w:1)}}f={count:u,texture:x,size:new Ct(v,A)},i.set(a,f),a.addEventListener("dispose",D)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)c.getUniforms().setValue(n,"morphTexture",o.morphTexture,e);else{let d=0;for(let _=0;_<l.length;_++)d+=l[_];let g=a.morphTargetsRelative?1:1-d;c.getUniforms().setValue(n,"morphTargetBaseInfluence",g),c.getUniforms().setValue(n,"morphTargetInfluences",l)}c.getUniforms().setValue(n,"morphTargetsTexture",f.texture,e),c.getUniforms().setValue(n,"morphTargetsTextureSize",f.size)}return{update:r}}function aw(n,t,e,i,s){let r=new WeakMap;function o(l){let h=s.render.frame,u=l.geometry,f=t.get(l,u);if(r.get(f)!==h&&(t.update(f),r.set(f,h)),l.isInstancedMesh&&(l.hasEventListener("dispose",c)===!1&&l.addEventListener("dispose",c),r.get(l)!==h&&(e.update(l.instanceMatrix,n.ARRAY_BUFFER),l.instanceColor!==null&&e.update(l.instanceColor,n.ARRAY_BUFFER),r.set(l,h))),l.isSkinnedMesh){let d=l.skeleton;r.get(d)!==h&&(d.update(),r.set(d,h))}return f}function a(){r=new WeakMap}function c(l){let h=l.target;h.removeEventListener("dispose",c),i.releaseStatesOfObject(h),e.remove(h.instanceMatrix),h.instanceColor!==null&&e.remove(h.instanceColor)}return{update:o,dispose:a}}var lw={[Hu]:"LINEAR_TONE_MAPPING",[Wu]:"REINHARD_TONE_MAPPING",[Xu]:"CINEON_TONE_MAPPING",[$u]:"ACES_FILMIC_TONE_MAPPING",[Yu]:"AGX_TONE_MAPPING",[Zu]:"NEUTRAL_TONE_MAPPING",[qu]:"CUSTOM_TONE_MAPPING"};function cw(n,t,e,i,s,r){let o=new fn(t,e,{type:n,depthBuffer:s,stencilBuffer:r,samples:i?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),a=null,c=null,l=null,h=new he;h.setAttribute("position",new Ht([-1,3,0,-1,-1,0,3,-1,0],3)),h.setAttribute("uv",new Ht([0,2,0,0,2,0],2));let u=new Ol({uniforms:{tDiffuse:{value:null}},vertexShader:`
			precision highp float;

			uniform mat4 modelViewMatrix;
			uniform mat4 projectionMatrix;

			attribute vec3 position;
			attribute vec2 uv;

			varying vec2 vUv;

			void main() {
				vUv = uv;
				gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
			}`,fragmentShader:`
			precision highp float;

			uniform sampler2D tDiffuse;

			varying vec2 vUv;

			#include <tonemapping_pars_fragment>
			#include <colorspace_pars_fragment>

			void main() {
				gl_FragColor = texture2D( tDiffuse, vUv );

				#ifdef LINEAR_TONE_MAPPING
					gl_FragColor.rgb = LinearToneMapping( gl_FragColor.rgb );
				#elif defined( REINHARD_TONE_MAPPING )
					gl_FragColor.rgb = ReinhardToneMapping( gl_FragColor.rgb );
				#elif defined( CINEON_TONE_MAPPING )
					gl_FragColor.rgb = CineonToneMapping( gl_FragColor.rgb );
				#elif defined( ACES_FILMIC_TONE_MAPPING )
					gl_FragColor.rgb = ACESFilmicToneMapping( gl_FragColor.rgb );
				#elif defined( AGX_TONE_MAPPING )
					gl_FragColor.rgb = AgXToneMapping( gl_FragColor.rgb );
				#elif defined( NEUTRAL_TONE_MAPPING )
					gl_FragColor.rgb = NeutralToneMapping( gl_FragColor.rgb );
				#elif defined( CUSTOM_TONE_MAPPING )
					gl_FragColor.rgb = CustomToneMapping( gl_FragColor.rgb );
				#endif

				#ifdef SRGB_TRANSFER
					gl_FragColor = sRGBTransferOETF( gl_FragColor );
				#endif
			}`,depthTest:!1,depthWrite:!1}),f=new _e(h,u),d=new Ro(-1,1,1,-1,0,1),g=null,_=null,m=!1,p,y=null,b=[],v=!1;this.setSize=function(A,E){o.setSize(A,E),a!==null&&a.setSize(A,E),c!==null&&c.setSize(A,E);for(let x=0;x<b.length;x++){let w=b[x];w.setSize&&w.setSize(A,E)}},this.setEffects=function(A){b=A,v=b.length>0&&b[0].isRenderPass===!0;let E=o.width,x=o.height;b.length>0&&a===null&&(a=new fn(E,x,{type:kn,depthBuffer:!1,stencilBuffer:!1}),c=new fn(E,x,{type:kn,depthBuffer:!1,stencilBuffer:!1}));let w=s===!0&&b.some(D=>D.needsDepthTexture===!0);w!==(o.depthTexture!==null)&&(w===!0&&l===null&&(l=new Mi(E,x),r===!0&&(l.format=Ei,l.type=ws)),o.dispose(),o.depthTexture=w?l:null,o.resolveDepthBuffer=w,o.storeMultisampledDepthBuffer=w);for(let D=0;D<b.length;D++){let R=b[D];R.setSize&&R.setSize(E,x),w&&R.needsDepthTexture===!0&&R.setDepthTexture&&R.setDepthTexture(l)}},this.begin=function(A,E){if(m||A.toneMapping===Zn&&b.length===0)return!1;if(y=E,E!==null){let x=E.width,w=E.height;(o.width!==x||o.height!==w)&&this.setSize(x,w)}return v===!1&&A.setRenderTarget(o),p=A.toneMapping,A.toneMapping=Zn,!0},this.hasRenderPass=function(){return v},this.end=function(A,E){A.toneMapping=p,m=!0;let x=o,w=a;for(let D=0;D<b.length;D++){let R=b[D];R.enabled!==!1&&(R.render(A,w,x,E),R.needsSwap!==!1&&(x=w,w=w===a?c:a))}if(g!==A.outputColorSpace||_!==A.toneMapping){g=A.outputColorSpace,_=A.toneMapping,u.defines={},Yt.getTransfer(g)===te&&(u.defines.SRGB_TRANSFER="");let D=lw[_];D&&(u.defines[D]=""),u.needsUpdate=!0}u.uniforms.tDiffuse.value=x.texture,A.setRenderTarget(y),A.render(f,d),y=null,m=!1},this.isCompositing=function(){return m},this.dispose=function(){o.dispose(),a!==null&&a.dispose(),c!==null&&c.dispose(),h.dispose(),u.dispose()}}var u0=new tn,f0=new Mi(1,1),d0=new vo(1),p0=new mo,m0=new Rl,g0=new yo,Wg=[],Xg=[],$g=new Float32Array(16),qg=new Float32Array(9),Yg=new Float32Array(4);function Pr(n,t,e){let i=n[0];if(i<=0||i>0)return n;let s=t*e,r=Wg[s];if(r===void 0&&(r=new Float32Array(s),Wg[s]=r),t!==0){i.toArray(r,0);for(let o=1,a=0;o!==t;++o)a+=e,n[o].toArray(r,a)}return r}function Me(n,t){if(n.length!==t.length)return!1;for(let e=0,i=n.length;e<i;e++)if(n[e]!==t[e])return!1;return!0}function Se(n,t){for(let e=0,i=t.length;e<i;e++)n[e]=t[e]}function Hc(n,t){let e=Xg[t];e===void 0&&(e=new Int32Array(t),Xg[t]=e);for(let i=0;i!==t;++i)e[i]=n.allocateTextureUnit();return e}function hw(n,t){let e=this.cache;e[0]!==t&&(n.uniform1f(this.addr,t),e[0]=t)}function uw(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(n.uniform2f(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Me(e,t))return;n.uniform2fv(this.addr,t),Se(e,t)}}function fw(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(n.uniform3f(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else if(t.r!==void 0)(e[0]!==t.r||e[1]!==t.g||e[2]!==t.b)&&(n.uniform3f(this.addr,t.r,t.g,t.b),e[0]=t.r,e[1]=t.g,e[2]=t.b);else{if(Me(e,t))return;n.uniform3fv(this.addr,t),Se(e,t)}}function dw(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(n.uniform4f(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Me(e,t))return;n.uniform4fv(this.addr,t),Se(e,t)}}function pw(n,t){let e=this.cache,i=t.elements;if(i===void 0){if(Me(e,t))return;n.uniformMatrix2fv(this.addr,!1,t),Se(e,t)}else{if(Me(e,i))return;Yg.set(i),n.uniformMatrix2fv(this.addr,!1,Yg),Se(e,i)}}function mw(n,t){let e=this.cache,i=t.elements;if(i===void 0){if(Me(e,t))return;n.uniformMatrix3fv(this.addr,!1,t),Se(e,t)}else{if(Me(e,i))return;qg.set(i),n.uniformMatrix3fv(this.addr,!1,qg),Se(e,i)}}function gw(n,t){let e=this.cache,i=t.elements;if(i===void 0){if(Me(e,t))return;n.uniformMatrix4fv(this.addr,!1,t),Se(e,t)}else{if(Me(e,i))return;$g.set(i),n.uniformMatrix4fv(this.addr,!1,$g),Se(e,i)}}function _w(n,t){let e=this.cache;e[0]!==t&&(n.uniform1i(this.addr,t),e[0]=t)}function xw(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(n.uniform2i(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Me(e,t))return;n.uniform2iv(this.addr,t),Se(e,t)}}function yw(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(n.uniform3i(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(Me(e,t))return;n.uniform3iv(this.addr,t),Se(e,t)}}function vw(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(n.uniform4i(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Me(e,t))return;n.uniform4iv(this.addr,t),Se(e,t)}}function bw(n,t){let e=this.cache;e[0]!==t&&(n.uniform1ui(this.addr,t),e[0]=t)}function Mw(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(n.uniform2ui(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Me(e,t))return;n.uniform2uiv(this.addr,t),Se(e,t)}}function Sw(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(n.uniform3ui(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(Me(e,t))return;n.uniform3uiv(this.addr,t),Se(e,t)}}function ww(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(n.uniform4ui(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Me(e,t))return;n.uniform4uiv(this.addr,t),Se(e,t)}}function Wc(n){return n.version===0&&(n.compareFunction=af,n.needsUpdate=!0),n}function Ew(n,t,e){let i=this.cache,s=e.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s);let r;this.type===n.SAMPLER_2D_SHADOW?r=Wc(f0):r=u0,e.setTexture2D(t||r,s)}function Aw(n,t,e){let i=this.cache,s=e.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s),e.setTexture3D(t||m0,s)}function Tw(n,t,e){let i=this.cache,s=e.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s);let r;this.type===n.SAMPLER_CUBE_SHADOW?r=Wc(d0):r=g0,e.setTextureCube(t||r,s)}function Cw(n,t,e){let i=this.cache,s=e.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s),e.setTexture2DArray(t||p0,s)}function Rw(n){switch(n){case 5126:return hw;case 35664:return uw;case 35665:return fw;case 35666:return dw;case 35674:return pw;case 35675:return mw;case 35676:return gw;case 5124:case 35670:return _w;case 35667:case 35671:return xw;case 35668:case 35672:return yw;case 35669:case 35673:return vw;case 5125:return bw;case 36294:return Mw;case 36295:return Sw;case 36296:return ww;case 35678:case 36198:case 36298:case 36306:case 35682:return Ew;case 35679:case 36299:case 36307:return Aw;case 35680:case 36300:case 36308:case 36293:return Tw;case 36289:case 36303:case 36311:case 36292:return Cw}}function Pw(n,t){n.uniform1fv(this.addr,t)}function Iw(n,t){let e=Pr(t,this.size,2);n.uniform2fv(this.addr,e)}function Lw(n,t){let e=Pr(t,this.size,3);n.uniform3fv(this.addr,e)}function Nw(n,t){let e=Pr(t,this.size,4);n.uniform4fv(this.addr,e)}function Dw(n,t){let e=Pr(t,this.size,4);n.uniformMatrix2fv(this.addr,!1,e)}function Uw(n,t){let e=Pr(t,this.size,9);n.uniformMatrix3fv(this.addr,!1,e)}function Ow(n,t){let e=Pr(t,this.size,16);n.uniformMatrix4fv(this.addr,!1,e)}function Fw(n,t){n.uniform1iv(this.addr,t)}function Bw(n,t){n.uniform2iv(this.addr,t)}function kw(n,t){n.uniform3iv(this.addr,t)}function zw(n,t){n.uniform4iv(this.addr,t)}function Vw(n,t){n.uniform1uiv(this.addr,t)}function Gw(n,t){n.uniform2uiv(this.addr,t)}function Hw(n,t){n.uniform3uiv(this.addr,t)}function Ww(n,t){n.uniform4uiv(this.addr,t)}function Xw(n,t,e){let i=this.cache,s=t.length,r=Hc(e,s);Me(i,r)||(n.uniform1iv(this.addr,r),Se(i,r));let o;this.type===n.SAMPLER_2D_SHADOW?o=Wc(f0):o=u0;for(let a=0;a!==s;++a)e.setTexture2D(t[a]||o,r[a])}function $w(n,t,e){let i=this.cache,s=t.length,r=Hc(e,s);Me(i,r)||(n.uniform1iv(this.addr,r),Se(i,r));for(let o=0;o!==s;++o)e.setTexture3D(t[o]||m0,r[o])}function qw(n,t,e){let i=this.cache,s=t.length,r=Hc(e,s);Me(i,r)||(n.uniform1iv(this.addr,r),Se(i,r));let o;this.type===n.SAMPLER_CUBE_SHADOW?o=Wc(d0):o=g0;for(let a=0;a!==s;++a)e.setTextureCube(t[a]||o,r[a])}function Yw(n,t,e){let i=this.cache,s=t.length,r=Hc(e,s);Me(i,r)||(n.uniform1iv(this.addr,r),Se(i,r));for(let o=0;o!==s;++o)e.setTexture2DArray(t[o]||p0,r[o])}function Zw(n){switch(n){case 5126:return Pw;case 35664:return Iw;case 35665:return Lw;case 35666:return Nw;case 35674:return Dw;case 35675:return Uw;case 35676:return Ow;case 5124:case 35670:return Fw;case 35667:case 35671:return Bw;case 35668:case 35672:return kw;case 35669:case 35673:return zw;case 5125:return Vw;case 36294:return Gw;case 36295:return Hw;case 36296:return Ww;case 35678:case 36198:case 36298:case 36306:case 35682:return Xw;case 35679:case 36299:case 36307:return $w;case 35680:case 36300:case 36308:case 36293:return qw;case 36289:case 36303:case 36311:case 36292:return Yw}}var vf=class{constructor(t,e,i){this.id=t,this.addr=i,this.cache=[],this.type=e.type,this.setValue=Rw(e.type)}},bf=class{constructor(t,e,i){this.id=t,this.addr=i,this.cache=[],this.type=e.type,this.size=e.size,this.setValue=Zw(e.type)}},Mf=class{constructor(t){this.id=t,this.seq=[],this.map={}}setValue(t,e,i){let s=this.seq;for(let r=0,o=s.length;r!==o;++r){let a=s[r];a.setValue(t,e[a.id],i)}}},xf=/(\w+)(\])?(\[|\.)?/g;function Zg(n,t){n.seq.push(t),n.map[t.id]=t}function Jw(n,t,e){let i=n.name,s=i.length;for(xf.lastIndex=0;;){let r=xf.exec(i),o=xf.lastIndex,a=r[1],c=r[2]==="]",l=r[3];if(c&&(a=a|0),l===void 0||l==="["&&o+2===s){Zg(e,l===void 0?new vf(a,n,t):new bf(a,n,t));break}else{let u=e.map[a];u===void 0&&(u=new Mf(a),Zg(e,u)),e=u}}}var Rr=class{constructor(t,e){this.seq=[],this.map={};let i=t.getProgramParameter(e,t.ACTIVE_UNIFORMS);for(let o=0;o<i;++o){let a=t.getActiveUniform(e,o),c=t.getUniformLocation(e,a.name);Jw(a,c,this)}let s=[],r=[];for(let o of this.seq)o.type===t.SAMPLER_2D_SHADOW||o.type===t.SAMPLER_CUBE_SHADOW||o.type===t.SAMPLER_2D_ARRAY_SHADOW?s.push(o):r.push(o);s.length>0&&(this.seq=s.concat(r))}setValue(t,e,i,s){let r=this.map[e];r!==void 0&&r.setValue(t,i,s)}setOptional(t,e,i){let s=e[i];s!==void 0&&this.setValue(t,i,s)}static upload(t,e,i,s){for(let r=0,o=e.length;r!==o;++r){let a=e[r],c=i[a.id];c.needsUpdate!==!1&&a.setValue(t,c.value,s)}}static seqWithValue(t,e){let i=[];for(let s=0,r=t.length;s!==r;++s){let o=t[s];o.id in e&&i.push(o)}return i}};function Jg(n,t,e){let i=n.createShader(t);return n.shaderSource(i,e),n.compileShader(i),i}var Kw=37297,jw=0;function Qw(n,t){let e=n.split(`
`),i=[],s=Math.max(t-6,0),r=Math.min(t+6,e.length);for(let o=s;o<r;o++){let a=o+1;i.push(`${a===t?">":" "} ${a}: ${e[o]}`)}return i.join(`
`)}var Kg=new Ut;function t1(n){Yt._getMatrix(Kg,Yt.workingColorSpace,n);let t=`mat3( ${Kg.elements.map(e=>e.toFixed(4))} )`;switch(Yt.getTransfer(n)){case uo:return[t,"LinearTransferOETF"];case te:return[t,"sRGBTransferOETF"];default:return It("WebGLProgram: Unsupported color space: ",n),[t,"LinearTransferOETF"]}}function jg(n,t,e){let i=n.getShaderParameter(t,n.COMPILE_STATUS),r=(n.getShaderInfoLog(t)||"").trim();if(i&&r==="")return"";let o=/ERROR: 0:(\d+)/.exec(r);if(o){let a=parseInt(o[1]);return e.toUpperCase()+`

`+r+`

`+Qw(n.getShaderSource(t),a)}else return r}function e1(n,t){let e=t1(t);return[`vec4 ${n}( vec4 value ) {`,`	return ${e[1]}( vec4( ${e[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var n1={[Hu]:"Linear",[Wu]:"Reinhard",[Xu]:"Cineon",[$u]:"ACESFilmic",[Yu]:"AgX",[Zu]:"Neutral",[qu]:"Custom"};function i1(n,t){let e=n1[t];return e===void 0?(It("WebGLProgram: Unsupported toneMapping:",t),"vec3 "+n+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+n+"( vec3 color ) { return "+e+"ToneMapping( color ); }"}var zc=new N;function s1(){Yt.getLuminanceCoefficients(zc);let n=zc.x.toFixed(4),t=zc.y.toFixed(4),e=zc.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${n}, ${t}, ${e} );`,"	return dot( weights, rgb );","}"].join(`
`)}function r1(n){return[n.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",n.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(qo).join(`
`)}function o1(n){let t=[];for(let e in n){let i=n[e];i!==!1&&t.push("#define "+e+" "+i)}return t.join(`
`)}function a1(n,t){let e={},i=n.getProgramParameter(t,n.ACTIVE_ATTRIBUTES);for(let s=0;s<i;s++){let r=n.getActiveAttrib(t,s),o=r.name,a=1;r.type===n.FLOAT_MAT2&&(a=2),r.type===n.FLOAT_MAT3&&(a=3),r.type===n.FLOAT_MAT4&&(a=4),e[o]={type:r.type,location:n.getAttribLocation(t,o),locationSize:a}}return e}function qo(n){return n!==""}function Qg(n,t){let e=t.numSpotLightShadows+t.numSpotLightMaps-t.numSpotLightShadowsWithMaps;return n.replace(/NUM_SUN_LIGHTS/g,t.numSunLights).replace(/NUM_DIR_LIGHTS/g,t.numDirLights).replace(/NUM_SPOT_LIGHTS/g,t.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,t.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,e).replace(/NUM_RECT_AREA_LIGHTS/g,t.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,t.numPointLights).replace(/NUM_HEMI_LIGHTS/g,t.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,t.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,t.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,t.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,t.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,t.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,t.numLightProbeGrids)}function t0(n,t){return n.replace(/NUM_CLIPPING_PLANES/g,t.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,t.numClippingPlanes-t.numClipIntersection)}var l1=/^[ \t]*#include +<([\w\d./]+)>/gm;function Sf(n){return n.replace(l1,c1)}function c1(n,t){let e=Gt[t];if(e===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+t+">");return Sf(e)}var h1=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function e0(n){return n.replace(h1,u1)}function u1(n,t,e,i){let s="";for(let r=parseInt(t);r<parseInt(e);r++)s+=i.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function n0(n){let t=`precision ${n.precision} float;
	precision ${n.precision} int;
	precision ${n.precision} sampler2D;
	precision ${n.precision} samplerCube;
	precision ${n.precision} sampler3D;
	precision ${n.precision} sampler2DArray;
	precision ${n.precision} sampler2DShadow;
	precision ${n.precision} samplerCubeShadow;
	precision ${n.precision} sampler2DArrayShadow;
	precision ${n.precision} isampler2D;
	precision ${n.precision} isampler3D;
	precision ${n.precision} isamplerCube;
	precision ${n.precision} isampler2DArray;
	precision ${n.precision} usampler2D;
	precision ${n.precision} usampler3D;
	precision ${n.precision} usamplerCube;
	precision ${n.precision} usampler2DArray;
	`;return n.precision==="highp"?t+=`
#define HIGH_PRECISION`:n.precision==="mediump"?t+=`
#define MEDIUM_PRECISION`:n.precision==="lowp"&&(t+=`
#define LOW_PRECISION`),t}var f1={[Oo]:"SHADOWMAP_TYPE_PCF",[Er]:"SHADOWMAP_TYPE_VSM"};function d1(n){return f1[n.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var p1={[Tr]:"ENVMAP_MODE_REFRACTION"};function m1(n){return n.envMap===!1?"ENVMAP_MODE_REFLECTION":p1[n.envMapMode]||"ENVMAP_MODE_REFLECTION"}var g1={[Kl]:"ENVMAP_BLENDING_MULTIPLY",[Mg]:"ENVMAP_BLENDING_MIX",[Sg]:"ENVMAP_BLENDING_ADD"};function _1(n){return n.envMap===!1?"ENVMAP_BLENDING_NONE":g1[n.combine]||"ENVMAP_BLENDING_NONE"}function x1(n,t,e,i){let s=n.getContext(),r=e.defines,o=e.vertexShader,a=e.fragmentShader,c=d1(e),l=e.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",h=m1(e),u=_1(e),f=r1(e),d=o1(r),g=s.createProgram(),_,m,p=e.glslVersion?"#version "+e.glslVersion+`
`:"";e.isRawShaderMaterial?(_=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,d].filter(qo).join(`
`),_.length>0&&(_+=`
`),m=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,d].filter(qo).join(`
`),m.length>0&&(m+=`
`)):(_=[n0(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,d,e.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",e.batching?"#define USE_BATCHING":"",e.batchingColor?"#define USE_BATCHING_COLOR":"",e.instancing?"#define USE_INSTANCING":"",e.instancingColor?"#define USE_INSTANCING_COLOR":"",e.instancingMorph?"#define USE_INSTANCING_MORPH":"",e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.map?"#define USE_MAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+h:"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.displacementMap?"#define USE_DISPLACEMENTMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.mapUv?"#define MAP_UV "+e.mapUv:"",e.alphaMapUv?"#define ALPHAMAP_UV "+e.alphaMapUv:"",e.lightMapUv?"#define LIGHTMAP_UV "+e.lightMapUv:"",e.aoMapUv?"#define AOMAP_UV "+e.aoMapUv:"",e.emissiveMapUv?"#define EMISSIVEMAP_UV "+e.emissiveMapUv:"",e.bumpMapUv?"#define BUMPMAP_UV "+e.bumpMapUv:"",e.normalMapUv?"#define NORMALMAP_UV "+e.normalMapUv:"",e.displacementMapUv?"#define DISPLACEMENTMAP_UV "+e.displacementMapUv:"",e.metalnessMapUv?"#define METALNESSMAP_UV "+e.metalnessMapUv:"",e.roughnessMapUv?"#define ROUGHNESSMAP_UV "+e.roughnessMapUv:"",e.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+e.anisotropyMapUv:"",e.clearcoatMapUv?"#define CLEARCOATMAP_UV "+e.clearcoatMapUv:"",e.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+e.clearcoatNormalMapUv:"",e.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+e.clearcoatRoughnessMapUv:"",e.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+e.diffuseRoughnessMapUv:"",e.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+e.iridescenceMapUv:"",e.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+e.iridescenceThicknessMapUv:"",e.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+e.sheenColorMapUv:"",e.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+e.sheenRoughnessMapUv:"",e.specularMapUv?"#define SPECULARMAP_UV "+e.specularMapUv:"",e.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+e.specularColorMapUv:"",e.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+e.specularIntensityMapUv:"",e.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+e.transmissionMapUv:"",e.thicknessMapUv?"#define THICKNESSMAP_UV "+e.thicknessMapUv:"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexNormals?"#define HAS_NORMAL":"",e.vertexColors?"#define USE_COLOR":"",e.vertexAlphas?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.flatShading?"#define FLAT_SHADED":"",e.skinning?"#define USE_SKINNING":"",e.morphTargets?"#define USE_MORPHTARGETS":"",e.morphNormals&&e.flatShading===!1?"#define USE_MORPHNORMALS":"",e.morphColors?"#define USE_MORPHCOLORS":"",e.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+e.morphTextureStride:"",e.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+e.morphTargetsCount:"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+c:"",e.sizeAttenuation?"#define USE_SIZEATTENUATION":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",e.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(qo).join(`
`),m=[n0(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,d,e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",e.map?"#define USE_MAP":"",e.matcap?"#define USE_MATCAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+l:"",e.envMap?"#define "+h:"",e.envMap?"#define "+u:"",e.envMapPMREM?"#define ENVMAP_MAX_LOD "+e.envMapMaxLod+".0":"",e.envMapPMREM?"#define ENVMAP_SIZE "+e.envMapSize+".0":"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoat?"#define USE_CLEARCOAT":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",e.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",e.dispersion?"#define USE_DISPERSION":"",e.retroreflection?"#define USE_RETROREFLECTION":"",e.iridescence?"#define USE_IRIDESCENCE":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaTest?"#define USE_ALPHATEST":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.sheen?"#define USE_SHEEN":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexColors||e.instancingColor?"#define USE_COLOR":"",e.vertexAlphas||e.batchingColor?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.gradientMap?"#define USE_GRADIENTMAP":"",e.flatShading?"#define FLAT_SHADED":"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+c:"",e.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",e.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",e.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",e.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",e.toneMapping!==Zn?"#define TONE_MAPPING":"",e.toneMapping!==Zn?Gt.tonemapping_pars_fragment:"",e.toneMapping!==Zn?i1("toneMapping",e.toneMapping):"",e.dithering?"#define DITHERING":"",e.opaque?"#define OPAQUE":"",Gt.colorspace_pars_fragment,e1("linearToOutputTexel",e.outputColorSpace),s1(),e.useDepthPacking?"#define DEPTH_PACKING "+e.depthPacking:"",`
`].filter(qo).join(`
`)),o=Sf(o),o=Qg(o,e),o=t0(o,e),a=Sf(a),a=Qg(a,e),a=t0(a,e),o=e0(o),a=e0(a),e.isRawShaderMaterial!==!0&&(p=`#version 300 es
`,_=[f,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+_,m=["#define varying in",e.glslVersion===cf?"":"layout(location = 0) out highp vec4 pc_fragColor;",e.glslVersion===cf?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+m);let y=p+_+o,b=p+m+a,v=Jg(s,s.VERTEX_SHADER,y),A=Jg(s,s.FRAGMENT_SHADER,b);s.attachShader(g,v),s.attachShader(g,A),e.index0AttributeName!==void 0?s.bindAttribLocation(g,0,e.index0AttributeName):e.hasPositionAttribute===!0&&s.bindAttribLocation(g,0,"position"),s.linkProgram(g);function E(R){if(n.debug.checkShaderErrors){let L=s.getProgramInfoLog(g)||"",I=s.getShaderInfoLog(v)||"",z=s.getShaderInfoLog(A)||"",C=L.trim(),H=I.trim(),q=z.trim(),V=!0,j=!0;if(s.getProgramParameter(g,s.LINK_STATUS)===!1)if(V=!1,typeof n.debug.onShaderError=="function")n.debug.onShaderError(s,g,v,A);else{let X=jg(s,v,"vertex"),Y=jg(s,A,"fragment");Nt("WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(g,s.VALIDATE_STATUS)+`

Material Name: `+R.name+`
Material Type: `+R.type+`

Program Info Log: `+C+`
`+X+`
`+Y)}else C!==""?It("WebGLProgram: Program Info Log:",C):(H===""||q==="")&&(j=!1);j&&(R.diagnostics={runnable:V,programLog:C,vertexShader:{log:H,prefix:_},fragmentShader:{log:q,prefix:m}})}s.deleteShader(v),s.deleteShader(A),x=new Rr(s,g),w=a1(s,g)}let x;this.getUniforms=function(){return x===void 0&&E(this),x};let w;this.getAttributes=function(){return w===void 0&&E(this),w};let D=e.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return D===!1&&(D=s.getProgramParameter(g,Kw)),D},this.destroy=function(){i.releaseStatesOfProgram(this),s.deleteProgram(g),this.program=void 0},this.type=e.shaderType,this.name=e.shaderName,this.id=jw++,this.cacheKey=t,this.usedTimes=1,this.program=g,this.vertexShader=v,this.fragmentShader=A,this}var y1=0,wf=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(t,e,i){let s=this._getShaderCacheForMaterial(t);return s.has(e)===!1&&(s.add(e),e.usedTimes++),s.has(i)===!1&&(s.add(i),i.usedTimes++),this}remove(t){let e=this.materialCache.get(t);for(let i of e)i.usedTimes--,i.usedTimes===0&&this.shaderCache.delete(i.code);return this.materialCache.delete(t),this}getVertexShaderStage(t){return this._getShaderStage(t.vertexShader)}getFragmentShaderStage(t){return this._getShaderStage(t.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(t){let e=this.materialCache,i=e.get(t);return i===void 0&&(i=new Set,e.set(t,i)),i}_getShaderStage(t){let e=this.shaderCache,i=e.get(t);return i===void 0&&(i=new Ef(t),e.set(t,i)),i}},Ef=class{constructor(t){this.id=y1++,this.code=t,this.usedTimes=0}};function v1(n){return n===qi||n===Go||n===Ho}function b1(n,t,e,i,s,r){let o=new vr,a=new wf,c=new Set,l=[],h=new Map,u=i.logarithmicDepthBuffer,f={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function d(x){return c.add(x),x===0?"uv":`uv${x}`}function g(x,w,D,R,L,I){let z=R.fog,C=L.geometry,H=x.isMeshStandardMaterial||x.isMeshLambertMaterial||x.isMeshPhongMaterial?R.environment:null,q=x.isMeshStandardMaterial||x.isMeshLambertMaterial&&!x.envMap||x.isMeshPhongMaterial&&!x.envMap,V=t.get(x.envMap||H,q),j=f[x.type],X=i.precision;x.precision!==null&&(X=i.getMaxPrecision(x.precision),X!==x.precision&&It("WebGLProgram.getParameters:",x.precision,"not supported, using",X,"instead."));let Y=C.morphAttributes.position||C.morphAttributes.normal||C.morphAttributes.color,st=Y!==void 0?Y.length:0,O=0;C.morphAttributes.position!==void 0&&(O=1),C.morphAttributes.normal!==void 0&&(O=2),C.morphAttributes.color!==void 0&&(O=3);let Z,B,et,it;if(j){let yt=en[j];Z=yt.vertexShader,B=yt.fragmentShader}else{Z=x.vertexShader,B=x.fragmentShader;let yt=a.getVertexShaderStage(x),ne=a.getFragmentShaderStage(x);a.update(x,yt,ne),et=yt.id,it=ne.id}let ot=n.getRenderTarget(),rt=n.state.buffers.depth.getReversed(),Mt=L.isInstancedMesh===!0,Wt=L.isBatchedMesh===!0,At=!!x.map,Dt=!!x.matcap,Xt=!!V,Pt=Xt&&V.isPMREMTexture===!0,ue=!!x.aoMap,ae=!!x.lightMap,ve=!!x.bumpMap&&x.wireframe===!1,me=!!x.normalMap,Vn=!!x.displacementMap,Ee=!!x.emissiveMap,mn=!!x.metalnessMap,gn=!!x.roughnessMap,_n=x.anisotropy>0,F=x.clearcoat>0,xn=x.diffuseRoughness>0,fe=x.dispersion>0,de=x.retroreflectivity>0,xt=x.iridescence>0,be=x.sheen>0,Lt=x.transmission>0,Ot=_n&&!!x.anisotropyMap,T=F&&!!x.clearcoatMap,M=F&&!!x.clearcoatNormalMap,G=F&&!!x.clearcoatRoughnessMap,at=xn&&!!x.diffuseRoughnessMap,nt=xt&&!!x.iridescenceMap,ht=xt&&!!x.iridescenceThicknessMap,mt=be&&!!x.sheenColorMap,K=be&&!!x.sheenRoughnessMap,Q=!!x.specularMap,ft=!!x.specularColorMap,P=!!x.specularIntensityMap,tt=Lt&&!!x.transmissionMap,J=Lt&&!!x.thicknessMap,dt=!!x.gradientMap,ct=!!x.alphaMap,ut=x.alphaTest>0,Tt=!!x.alphaHash,Vt=!!x.extensions,lt=Zn;x.toneMapped&&(ot===null||ot.isXRRenderTarget===!0)&&(lt=n.toneMapping);let Rt=Pt?V.isCompressedCubeTexture?V.image[0].mipmaps:V.mipmaps:null,kt={shaderID:j,shaderType:x.type,shaderName:x.name,vertexShader:Z,fragmentShader:B,defines:x.defines,customVertexShaderID:et,customFragmentShaderID:it,isRawShaderMaterial:x.isRawShaderMaterial===!0,glslVersion:x.glslVersion,precision:X,batching:Wt,batchingColor:Wt&&L._colorsTexture!==null,instancing:Mt,instancingColor:Mt&&L.instanceColor!==null,instancingMorph:Mt&&L.morphTexture!==null,outputColorSpace:ot===null?n.outputColorSpace:ot.isXRRenderTarget===!0?ot.texture.colorSpace:Yt.workingColorSpace,alphaToCoverage:!!x.alphaToCoverage,map:At,matcap:Dt,envMap:Xt,envMapMode:Xt&&V.mapping,envMapPMREM:Pt,envMapMaxLod:Pt?Rt.length-1:null,envMapSize:Pt?Rt[0].width:null,aoMap:ue,lightMap:ae,bumpMap:ve,normalMap:me,displacementMap:Vn,emissiveMap:Ee,normalMapObjectSpace:me&&x.normalMapType===Ag,normalMapTangentSpace:me&&x.normalMapType===Fc,packedNormalMap:me&&x.normalMapType===Fc&&v1(x.normalMap.format),metalnessMap:mn,roughnessMap:gn,anisotropy:_n,anisotropyMap:Ot,clearcoat:F,clearcoatMap:T,clearcoatNormalMap:M,clearcoatRoughnessMap:G,diffuseRoughness:xn,diffuseRoughnessMap:at,dispersion:fe,retroreflection:de,iridescence:xt,iridescenceMap:nt,iridescenceThicknessMap:ht,sheen:be,sheenColorMap:mt,sheenRoughnessMap:K,specularMap:Q,specularColorMap:ft,specularIntensityMap:P,transmission:Lt,transmissionMap:tt,thicknessMap:J,gradientMap:dt,opaque:x.transparent===!1&&x.blending===Ar&&x.alphaToCoverage===!1,alphaMap:ct,alphaTest:ut,alphaHash:Tt,combine:x.combine,mapUv:At&&d(x.map.channel),aoMapUv:ue&&d(x.aoMap.channel),lightMapUv:ae&&d(x.lightMap.channel),bumpMapUv:ve&&d(x.bumpMap.channel),normalMapUv:me&&d(x.normalMap.channel),displacementMapUv:Vn&&d(x.displacementMap.channel),emissiveMapUv:Ee&&d(x.emissiveMap.channel),metalnessMapUv:mn&&d(x.metalnessMap.channel),roughnessMapUv:gn&&d(x.roughnessMap.channel),anisotropyMapUv:Ot&&d(x.anisotropyMap.channel),clearcoatMapUv:T&&d(x.clearcoatMap.channel),clearcoatNormalMapUv:M&&d(x.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:G&&d(x.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:at&&d(x.diffuseRoughnessMap.channel),iridescenceMapUv:nt&&d(x.iridescenceMap.channel),iridescenceThicknessMapUv:ht&&d(x.iridescenceThicknessMap.channel),sheenColorMapUv:mt&&d(x.sheenColorMap.channel),sheenRoughnessMapUv:K&&d(x.sheenRoughnessMap.channel),specularMapUv:Q&&d(x.specularMap.channel),specularColorMapUv:ft&&d(x.specularColorMap.channel),specularIntensityMapUv:P&&d(x.specularIntensityMap.channel),transmissionMapUv:tt&&d(x.transmissionMap.channel),thicknessMapUv:J&&d(x.thicknessMap.channel),alphaMapUv:ct&&d(x.alphaMap.channel),vertexTangents:!!C.attributes.tangent&&(me||_n),vertexNormals:!!C.attributes.normal,vertexColors:x.vertexColors,vertexAlphas:x.vertexColors===!0&&!!C.attributes.color&&C.attributes.color.itemSize===4,pointsUvs:L.isPoints===!0&&!!C.attributes.uv&&(At||ct),fog:!!z,useFog:x.fog===!0,fogExp2:!!z&&z.isFogExp2,flatShading:x.wireframe===!1&&(x.flatShading===!0||C.attributes.normal===void 0&&me===!1&&(x.isMeshLambertMaterial||x.isMeshPhongMaterial||x.isMeshStandardMaterial||x.isMeshPhysicalMaterial)),sizeAttenuation:x.sizeAttenuation===!0,logarithmicDepthBuffer:u,reversedDepthBuffer:rt,skinning:L.isSkinnedMesh===!0,hasPositionAttribute:C.attributes.position!==void 0,morphTargets:C.morphAttributes.position!==void 0,morphNormals:C.morphAttributes.normal!==void 0,morphColors:C.morphAttributes.color!==void 0,morphTargetsCount:st,morphTextureStride:O,numSunLights:w.sun.length,numDirLights:w.directional.length,numPointLights:w.point.length,numSpotLights:w.spot.length,numSpotLightMaps:w.spotLightMap.length,numRectAreaLights:w.rectArea.length,numHemiLights:w.hemi.length,numSunLightShadows:w.sunShadowMap.length,numDirLightShadows:w.directionalShadowMap.length,numPointLightShadows:w.pointShadowMap.length,numSpotLightShadows:w.spotShadowMap.length,numSpotLightShadowsWithMaps:w.numSpotLightShadowsWithMaps,numLightProbes:w.numLightProbes,numLightProbeGrids:I.filter(yt=>yt.texture!==null).length,numClippingPlanes:r.numPlanes,numClipIntersection:r.numIntersection,dithering:x.dithering,shadowMapEnabled:n.shadowMap.enabled&&D.length>0,shadowMapType:n.shadowMap.type,toneMapping:lt,decodeVideoTexture:At&&x.map.isVideoTexture===!0&&Yt.getTransfer(x.map.colorSpace)===te,decodeVideoTextureEmissive:Ee&&x.emissiveMap.isVideoTexture===!0&&Yt.getTransfer(x.emissiveMap.colorSpace)===te,premultipliedAlpha:x.premultipliedAlpha,doubleSided:x.side===Sn,flipSided:x.side===De,useDepthPacking:x.depthPacking>=0,depthPacking:x.depthPacking||0,index0AttributeName:x.index0AttributeName,extensionClipCullDistance:Vt&&x.extensions.clipCullDistance===!0&&e.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(Vt&&x.extensions.multiDraw===!0||Wt)&&e.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:e.has("KHR_parallel_shader_compile"),customProgramCacheKey:x.customProgramCacheKey()};return kt.vertexUv1s=c.has(1),kt.vertexUv2s=c.has(2),kt.vertexUv3s=c.has(3),c.clear(),kt}function _(x){let w=[];if(x.shaderID?w.push(x.shaderID):(w.push(x.customVertexShaderID),w.push(x.customFragmentShaderID)),x.defines!==void 0)for(let D in x.defines)w.push(D),w.push(x.defines[D]);return x.isRawShaderMaterial===!1&&(m(w,x),p(w,x),w.push(n.outputColorSpace)),w.push(x.customProgramCacheKey),w.join()}function m(x,w){x.push(w.precision),x.push(w.outputColorSpace),x.push(w.envMapMode),x.push(w.envMapPMREM),x.push(w.envMapMaxLod),x.push(w.envMapSize),x.push(w.mapUv),x.push(w.alphaMapUv),x.push(w.lightMapUv),x.push(w.aoMapUv),x.push(w.bumpMapUv),x.push(w.normalMapUv),x.push(w.displacementMapUv),x.push(w.emissiveMapUv),x.push(w.metalnessMapUv),x.push(w.roughnessMapUv),x.push(w.anisotropyMapUv),x.push(w.clearcoatMapUv),x.push(w.clearcoatNormalMapUv),x.push(w.clearcoatRoughnessMapUv),x.push(w.diffuseRoughnessMapUv),x.push(w.iridescenceMapUv),x.push(w.iridescenceThicknessMapUv),x.push(w.sheenColorMapUv),x.push(w.sheenRoughnessMapUv),x.push(w.specularMapUv),x.push(w.specularColorMapUv),x.push(w.specularIntensityMapUv),x.push(w.transmissionMapUv),x.push(w.thicknessMapUv),x.push(w.combine),x.push(w.fogExp2),x.push(w.sizeAttenuation),x.push(w.morphTargetsCount),x.push(w.numSunLights),x.push(w.numDirLights),x.push(w.numPointLights),x.push(w.numSpotLights),x.push(w.numSpotLightMaps),x.push(w.numHemiLights),x.push(w.numRectAreaLights),x.push(w.numSunLightShadows),x.push(w.numDirLightShadows),x.push(w.numPointLightShadows),x.push(w.numSpotLightShadows),x.push(w.numSpotLightShadowsWithMaps),x.push(w.numLightProbes),x.push(w.numLightProbeGrids),x.push(w.shadowMapType),x.push(w.toneMapping),x.push(w.numClippingPlanes),x.push(w.numClipIntersection),x.push(w.depthPacking)}function p(x,w){o.disableAll(),w.instancing&&o.enable(0),w.instancingColor&&o.enable(1),w.instancingMorph&&o.enable(2),w.matcap&&o.enable(3),w.envMap&&o.enable(4),w.normalMapObjectSpace&&o.enable(5),w.normalMapTangentSpace&&o.enable(6),w.clearcoat&&o.enable(7),w.iridescence&&o.enable(8),w.alphaTest&&o.enable(9),w.vertexColors&&o.enable(10),w.vertexAlphas&&o.enable(11),w.vertexUv1s&&o.enable(12),w.vertexUv2s&&o.enable(13),w.vertexUv3s&&o.enable(14),w.vertexTangents&&o.enable(15),w.anisotropy&&o.enable(16),w.alphaHash&&o.enable(17),w.batching&&o.enable(18),w.dispersion&&o.enable(19),w.retroreflection&&o.enable(24),w.diffuseRoughness&&o.enable(25),w.batchingColor&&o.enable(20),w.gradientMap&&o.enable(21),w.packedNormalMap&&o.enable(22),w.vertexNormals&&o.enable(23),x.push(o.mask),o.disableAll(),w.fog&&o.enable(0),w.useFog&&o.enable(1),w.flatShading&&o.enable(2),w.logarithmicDepthBuffer&&o.enable(3),w.reversedDepthBuffer&&o.enable(4),w.skinning&&o.enable(5),w.morphTargets&&o.enable(6),w.morphNormals&&o.enable(7),w.morphColors&&o.enable(8),w.premultipliedAlpha&&o.enable(9),w.shadowMapEnabled&&o.enable(10),w.doubleSided&&o.enable(11),w.flipSided&&o.enable(12),w.useDepthPacking&&o.enable(13),w.dithering&&o.enable(14),w.transmission&&o.enable(15),w.sheen&&o.enable(16),w.opaque&&o.enable(17),w.pointsUvs&&o.enable(18),w.decodeVideoTexture&&o.enable(19),w.decodeVideoTextureEmissive&&o.enable(20),w.alphaToCoverage&&o.enable(21),w.numLightProbeGrids>0&&o.enable(22),w.hasPositionAttribute&&o.enable(23),x.push(o.mask)}function y(x){let w=f[x.type],D;if(w){let R=en[w];D=Xo.clone(R.uniforms)}else D=x.uniforms;return D}function b(x,w){let D=h.get(w);return D!==void 0?++D.usedTimes:(D=new x1(n,w,x,s),l.push(D),h.set(w,D)),D}function v(x){if(--x.usedTimes===0){let w=l.indexOf(x);l[w]=l[l.length-1],l.pop(),h.delete(x.cacheKey),x.destroy()}}function A(x){a.remove(x)}function E(){a.dispose()}return{getParameters:g,getProgramCacheKey:_,getUniforms:y,acquireProgram:b,releaseProgram:v,releaseShaderCache:A,programs:l,dispose:E}}function M1(){let n=new WeakMap;function t(o){return n.has(o)}function e(o){let a=n.get(o);return a===void 0&&(a={},n.set(o,a)),a}function i(o){n.delete(o)}function s(o,a,c){n.get(o)[a]=c}function r(){n=new WeakMap}return{has:t,get:e,remove:i,update:s,dispose:r}}function S1(n,t){return n.groupOrder!==t.groupOrder?n.groupOrder-t.groupOrder:n.renderOrder!==t.renderOrder?n.renderOrder-t.renderOrder:n.material.id!==t.material.id?n.material.id-t.material.id:n.materialVariant!==t.materialVariant?n.materialVariant-t.materialVariant:n.z!==t.z?n.z-t.z:n.id-t.id}function i0(n,t){return n.groupOrder!==t.groupOrder?n.groupOrder-t.groupOrder:n.renderOrder!==t.renderOrder?n.renderOrder-t.renderOrder:n.z!==t.z?t.z-n.z:n.id-t.id}function s0(){let n=[],t=0,e=[],i=[],s=[];function r(){t=0,e.length=0,i.length=0,s.length=0}function o(f){let d=0;return f.isInstancedMesh&&(d+=2),f.isSkinnedMesh&&(d+=1),d}function a(f,d,g,_,m,p){let y=n[t];return y===void 0?(y={id:f.id,object:f,geometry:d,material:g,materialVariant:o(f),groupOrder:_,renderOrder:f.renderOrder,z:m,group:p},n[t]=y):(y.id=f.id,y.object=f,y.geometry=d,y.material=g,y.materialVariant=o(f),y.groupOrder=_,y.renderOrder=f.renderOrder,y.z=m,y.group=p),t++,y}function c(f,d,g,_,m,p,y){y.reversedDepth===!0&&(m=-m);let b=a(f,d,g,_,m,p);g.transmission>0?i.push(b):g.transparent===!0?s.push(b):e.push(b)}function l(f,d,g,_,m,p){let y=a(f,d,g,_,m,p);g.transmission>0?i.unshift(y):g.transparent===!0?s.unshift(y):e.unshift(y)}function h(f,d){e.length>1&&e.sort(f||S1),i.length>1&&i.sort(d||i0),s.length>1&&s.sort(d||i0)}function u(){for(let f=t,d=n.length;f<d;f++){let g=n[f];if(g.id===null)break;g.id=null,g.object=null,g.geometry=null,g.material=null,g.group=null}}return{opaque:e,transmissive:i,transparent:s,init:r,push:c,unshift:l,finish:u,sort:h}}function w1(){let n=new WeakMap;function t(i,s){let r=n.get(i),o;return r===void 0?(o=new s0,n.set(i,[o])):s>=r.length?(o=new s0,r.push(o)):o=r[s],o}function e(){n=new WeakMap}return{get:t,dispose:e}}function E1(){let n={};return{get:function(t){if(n[t.id]!==void 0)return n[t.id];let e;switch(t.type){case"SunLight":case"DirectionalLight":e={direction:new N,color:new zt};break;case"SpotLight":e={position:new N,direction:new N,color:new zt,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":e={position:new N,color:new zt,distance:0,decay:0};break;case"HemisphereLight":e={direction:new N,skyColor:new zt,groundColor:new zt};break;case"RectAreaLight":e={color:new zt,position:new N,halfWidth:new N,halfHeight:new N};break}return n[t.id]=e,e}}}function A1(){let n={};return{get:function(t){if(n[t.id]!==void 0)return n[t.id];let e;switch(t.type){case"SunLight":case"DirectionalLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Ct};break;case"SpotLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Ct};break;case"PointLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Ct,shadowCameraNear:1,shadowCameraFar:1e3};break}return n[t.id]=e,e}}}var T1=0;function C1(n,t){return(t.castShadow?2:0)-(n.castShadow?2:0)+(t.map?1:0)-(n.map?1:0)}function R1(n){let t=new E1,e=A1(),i={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let l=0;l<9;l++)i.probe.push(new N);let s=new N,r=new se,o=new se;function a(l){let h=0,u=0,f=0;for(let I=0;I<9;I++)i.probe[I].set(0,0,0);let d=0,g=0,_=0,m=0,p=0,y=0,b=0,v=0,A=0,E=0,x=0,w=0,D=0,R=0;l.sort(C1);for(let I=0,z=l.length;I<z;I++){let C=l[I],H=C.color,q=C.intensity,V=C.distance,j=null;if(C.shadow&&C.shadow.map&&(C.shadow.map.texture.format===qi?j=C.shadow.map.texture:j=C.shadow.map.depthTexture||C.shadow.map.texture),C.isAmbientLight)h+=H.r*q,u+=H.g*q,f+=H.b*q;else if(C.isLightProbe){for(let X=0;X<9;X++)i.probe[X].addScaledVector(C.sh.coefficients[X],q);R++}else if(C.isSunLight){let X=t.get(C);if(X.color.copy(C.color).multiplyScalar(C.intensity),C.castShadow){let Y=C.shadow,st=e.get(C);st.shadowIntensity=Y.intensity,st.shadowBias=Y.bias,st.shadowNormalBias=Y.normalBias,st.shadowRadius=Y.radius,st.shadowMapSize.copy(Y.mapSize).multiply(Y.getFrameExtents()),i.sunShadow[g]=st,i.sunShadowMap[g]=j;let O=Y.getViewportCount();for(let Z=0;Z<O;Z++)i.sunShadowMatrix[_+Z]=Y.getMatrix(Z),i.sunShadowCascade[_+Z]=Y._cascadeData[Z];_+=O,g++}i.sun[d]=X,d++}else if(C.isDirectionalLight){let X=t.get(C);if(X.color.copy(C.color).multiplyScalar(C.intensity),C.castShadow){let Y=C.shadow,st=e.get(C);st.shadowIntensity=Y.intensity,st.shadowBias=Y.bias,st.shadowNormalBias=Y.normalBias,st.shadowRadius=Y.radius,st.shadowMapSize=Y.mapSize,i.directionalShadow[m]=st,i.directionalShadowMap[m]=j,i.directionalShadowMatrix[m]=C.shadow.matrix,A++}i.directional[m]=X,m++}else if(C.isSpotLight){let X=t.get(C);X.position.setFromMatrixPosition(C.matrixWorld),X.color.copy(H).multiplyScalar(q),X.distance=V,X.coneCos=Math.cos(C.angle),X.penumbraCos=Math.cos(C.angle*(1-C.penumbra)),X.decay=C.decay,i.spot[y]=X;let Y=C.shadow;if(C.map&&(i.spotLightMap[w]=C.map,w++,Y.updateMatrices(C),C.castShadow&&D++),i.spotLightMatrix[y]=Y.matrix,C.castShadow){let st=e.get(C);st.shadowIntensity=Y.intensity,st.shadowBias=Y.bias,st.shadowNormalBias=Y.normalBias,st.shadowRadius=Y.radius,st.shadowMapSize=Y.mapSize,i.spotShadow[y]=st,i.spotShadowMap[y]=j,x++}y++}else if(C.isRectAreaLight){let X=t.get(C);X.color.copy(H).multiplyScalar(q),X.halfWidth.set(C.width*.5,0,0),X.halfHeight.set(0,C.height*.5,0),i.rectArea[b]=X,b++}else if(C.isPointLight){let X=t.get(C);if(X.color.copy(C.color).multiplyScalar(C.intensity),X.distance=C.distance,X.decay=C.decay,C.castShadow){let Y=C.shadow,st=e.get(C);st.shadowIntensity=Y.intensity,st.shadowBias=Y.bias,st.shadowNormalBias=Y.normalBias,st.shadowRadius=Y.radius,st.shadowMapSize=Y.mapSize,st.shadowCameraNear=Y.camera.near,st.shadowCameraFar=Y.camera.far,i.pointShadow[p]=st,i.pointShadowMap[p]=j,i.pointShadowMatrix[p]=C.shadow.matrix,E++}i.point[p]=X,p++}else if(C.isHemisphereLight){let X=t.get(C);X.skyColor.copy(C.color).multiplyScalar(q),X.groundColor.copy(C.groundColor).multiplyScalar(q),i.hemi[v]=X,v++}}b>0&&(n.has("OES_texture_float_linear")===!0?(i.rectAreaLTC1=_t.LTC_FLOAT_1,i.rectAreaLTC2=_t.LTC_FLOAT_2):(i.rectAreaLTC1=_t.LTC_HALF_1,i.rectAreaLTC2=_t.LTC_HALF_2)),i.ambient[0]=h,i.ambient[1]=u,i.ambient[2]=f;let L=i.hash;(L.sunLength!==d||L.directionalLength!==m||L.pointLength!==p||L.spotLength!==y||L.rectAreaLength!==b||L.hemiLength!==v||L.numSunShadows!==g||L.numDirectionalShadows!==A||L.numPointShadows!==E||L.numSpotShadows!==x||L.numSpotMaps!==w||L.numLightProbes!==R)&&(i.sun.length=d,i.directional.length=m,i.spot.length=y,i.rectArea.length=b,i.point.length=p,i.hemi.length=v,i.sunShadow.length=g,i.sunShadowMap.length=g,i.sunShadowMatrix.length=_,i.sunShadowCascade.length=_,i.directionalShadow.length=A,i.directionalShadowMap.length=A,i.directionalShadowMatrix.length=A,i.pointShadow.length=E,i.pointShadowMap.length=E,i.pointShadowMatrix.length=E,i.spotShadow.length=x,i.spotShadowMap.length=x,i.spotLightMatrix.length=x+w-D,i.spotLightMap.length=w,i.numSpotLightShadowsWithMaps=D,i.numLightProbes=R,L.sunLength=d,L.directionalLength=m,L.pointLength=p,L.spotLength=y,L.rectAreaLength=b,L.hemiLength=v,L.numSunShadows=g,L.numDirectionalShadows=A,L.numPointShadows=E,L.numSpotShadows=x,L.numSpotMaps=w,L.numLightProbes=R,i.version=T1++)}function c(l,h){let u=0,f=0,d=0,g=0,_=0,m=0,p=h.matrixWorldInverse;for(let y=0,b=l.length;y<b;y++){let v=l[y];if(v.isSunLight){let A=i.sun[u];A.direction.setFromMatrixPosition(v.matrixWorld),A.direction.transformDirection(p),u++}else if(v.isDirectionalLight){let A=i.directional[f];A.direction.setFromMatrixPosition(v.matrixWorld),s.setFromMatrixPosition(v.target.matrixWorld),A.direction.sub(s),A.direction.transformDirection(p),f++}else if(v.isSpotLight){let A=i.spot[g];A.position.setFromMatrixPosition(v.matrixWorld),A.position.applyMatrix4(p),A.direction.setFromMatrixPosition(v.matrixWorld),s.setFromMatrixPosition(v.target.matrixWorld),A.direction.sub(s),A.direction.transformDirection(p),g++}else if(v.isRectAreaLight){let A=i.rectArea[_];A.position.setFromMatrixPosition(v.matrixWorld),A.position.applyMatrix4(p),o.identity(),r.copy(v.matrixWorld),r.premultiply(p),o.extractRotation(r),A.halfWidth.set(v.width*.5,0,0),A.halfHeight.set(0,v.height*.5,0),A.halfWidth.applyMatrix4(o),A.halfHeight.applyMatrix4(o),_++}else if(v.isPointLight){let A=i.point[d];A.position.setFromMatrixPosition(v.matrixWorld),A.position.applyMatrix4(p),d++}else if(v.isHemisphereLight){let A=i.hemi[m];A.direction.setFromMatrixPosition(v.matrixWorld),A.direction.transformDirection(p),m++}}}return{setup:a,setupView:c,state:i}}function r0(n){let t=new R1(n),e=[],i=[],s=[];function r(u){h.camera=u,e.length=0,i.length=0,s.length=0}function o(u){u.isLightProbeGrid?s.push(u):e.push(u)}function a(u){i.push(u)}function c(){t.setup(e),s.sort((u,f)=>u.priority-f.priority||u.id-f.id)}function l(u){t.setupView(e,u)}let h={lightsArray:e,shadowsArray:i,lightProbeGridArray:s,camera:null,lights:t,transmissionRenderTarget:{},textureUnits:0};return{init:r,state:h,setupLights:c,setupLightsView:l,pushLight:o,pushShadow:a}}function P1(n){let t=new WeakMap;function e(s,r=0){let o=t.get(s),a;return o===void 0?(a=new r0(n),t.set(s,[a])):r>=o.length?(a=new r0(n),o.push(a)):a=o[r],a}function i(){t=new WeakMap}return{get:e,dispose:i}}var I1=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,L1=`uniform sampler2D shadow_pass;
uniform vec2 resolution;
uniform float radius;
void main() {
	const float samples = float( VSM_SAMPLES );
	float mean = 0.0;
	float squared_mean = 0.0;
	float uvStride = samples <= 1.0 ? 0.0 : 2.0 / ( samples - 1.0 );
	float uvStart = samples <= 1.0 ? 0.0 : - 1.0;
	for ( float i = 0.0; i < samples; i ++ ) {
		float uvOffset = uvStart + i * uvStride;
		#ifdef HORIZONTAL_PASS
			vec2 distribution = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( uvOffset, 0.0 ) * radius ) / resolution ).rg;
			mean += distribution.x;
			squared_mean += distribution.y * distribution.y + distribution.x * distribution.x;
		#else
			float depth = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( 0.0, uvOffset ) * radius ) / resolution ).r;
			mean += depth;
			squared_mean += depth * depth;
		#endif
	}
	mean = mean / samples;
	squared_mean = squared_mean / samples;
	float std_dev = sqrt( max( 0.0, squared_mean - mean * mean ) );
	gl_FragColor = vec4( mean, std_dev, 0.0, 1.0 );
}`,N1=[new N(1,0,0),new N(-1,0,0),new N(0,1,0),new N(0,-1,0),new N(0,0,1),new N(0,0,-1)],D1=[new N(0,-1,0),new N(0,-1,0),new N(0,0,1),new N(0,0,-1),new N(0,-1,0),new N(0,-1,0)],o0=new se,$o=new N,yf=new N;function U1(n,t,e){let i=new Bi,s=new Ct,r=new Ct,o=new ee,a=new Fl,c=new Bl,l={},h=e.maxTextureSize,u={[$i]:De,[De]:$i,[Sn]:Sn},f=new Mn({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new Ct},radius:{value:4}},vertexShader:I1,fragmentShader:L1}),d=f.clone();d.defines.HORIZONTAL_PASS=1;let g=new he;g.setAttribute("position",new Ln(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let _=new _e(g,f),m=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=Oo;let p=this.type;this.render=function(E,x,w){if(m.enabled===!1||m.autoUpdate===!1&&m.needsUpdate===!1||E.length===0)return;this.type===ig&&(It("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=Oo);let D=n.getRenderTarget(),R=n.getActiveCubeFace(),L=n.getActiveMipmapLevel(),I=n.state;I.setBlending(bs),I.buffers.depth.getReversed()===!0?I.buffers.color.setClear(0,0,0,0):I.buffers.color.setClear(1,1,1,1),I.buffers.depth.setTest(!0),I.setScissorTest(!1);let z=p!==this.type;z&&x.traverse(function(C){C.material&&(Array.isArray(C.material)?C.material.forEach(H=>H.needsUpdate=!0):C.material.needsUpdate=!0)});for(let C=0,H=E.length;C<H;C++){let q=E[C],V=q.shadow;if(V===void 0){It("WebGLShadowMap:",q,"has no shadow.");continue}if(V.autoUpdate===!1&&V.needsUpdate===!1)continue;s.copy(V.mapSize);let j=V.getFrameExtents();s.multiply(j),r.copy(V.mapSize),(s.x>h||s.y>h)&&(s.x>h&&(r.x=Math.floor(h/j.x),s.x=r.x*j.x,V.mapSize.x=r.x),s.y>h&&(r.y=Math.floor(h/j.y),s.y=r.y*j.y,V.mapSize.y=r.y));let X=n.state.buffers.depth.getReversed();if(V.camera._reversedDepth=X,V.map===null||z===!0){if(V.map!==null&&(V.map.depthTexture!==null&&(V.map.depthTexture.dispose(),V.map.depthTexture=null),V.map.dispose()),this.type===Er){if(q.isPointLight){It("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}V.map=new fn(s.x,s.y,{format:qi,type:kn,minFilter:Qe,magFilter:Qe,generateMipmaps:!1}),V.map.texture.name=q.name+".shadowMap",V.map.depthTexture=new Mi(s.x,s.y,Bn),V.map.depthTexture.name=q.name+".shadowMapDepth",V.map.depthTexture.format=xi,V.map.depthTexture.compareFunction=null,V.map.depthTexture.minFilter=Ie,V.map.depthTexture.magFilter=Ie}else q.isPointLight?(V.map=new Yo(s.x),V.map.depthTexture=new vo(s.x,Fn)):(V.map=new fn(s.x,s.y),V.map.depthTexture=new Mi(s.x,s.y,Fn)),V.map.depthTexture.name=q.name+".shadowMap",V.map.depthTexture.format=xi,this.type===Oo?(V.map.depthTexture.compareFunction=X?of:rf,V.map.depthTexture.minFilter=Qe,V.map.depthTexture.magFilter=Qe):(V.map.depthTexture.compareFunction=null,V.map.depthTexture.minFilter=Ie,V.map.depthTexture.magFilter=Ie);V.camera.updateProjectionMatrix()}V.map.isWebGLCubeRenderTarget!==!0&&(V.map.width!==s.x||V.map.height!==s.y)&&V.map.setSize(s.x,s.y);let Y=V.map.isWebGLCubeRenderTarget?6:V.getViewportCount();q.isPointLight!==!0&&V.updateMatrices(q,w);let st=(V.camera.layers.mask&4294967294)!==0?V.camera.layers:w.layers;for(let O=0;O<Y;O++){let Z=V.getCamera(O);if(q.isPointLight){let B=V.camera,et=V.matrix,it=q.distance||B.far;it!==B.far&&(B.far=it,B.updateProjectionMatrix()),$o.setFromMatrixPosition(q.matrixWorld),B.position.copy($o),yf.copy(B.position),yf.add(N1[O]),B.up.copy(D1[O]),B.lookAt(yf),B.updateMatrixWorld(),et.makeTranslation(-$o.x,-$o.y,-$o.z),o0.multiplyMatrices(B.projectionMatrix,B.matrixWorldInverse),V._frustum.setFromProjectionMatrix(o0,B.coordinateSystem,B.reversedDepth)}if(V.map.isWebGLCubeRenderTarget)n.setRenderTarget(V.map,O),n.clear();else{O===0&&(n.setRenderTarget(V.map),n.clear());let B=V.getViewport(O);o.set(r.x*B.x,r.y*B.y,r.x*B.z,r.y*B.w),I.viewport(o)}i=V.getFrustum(O),v(x,w,Z,q,st,this.type)}V.isPointLightShadow!==!0&&this.type===Er&&y(V,w),V.needsUpdate=!1}p=this.type,m.needsUpdate=!1,n.setRenderTarget(D,R,L)};function y(E,x){let w=t.update(_);f.defines.VSM_SAMPLES!==E.blurSamples&&(f.defines.VSM_SAMPLES=E.blurSamples,d.defines.VSM_SAMPLES=E.blurSamples,f.needsUpdate=!0,d.needsUpdate=!0),E.mapPass===null?E.mapPass=new fn(s.x,s.y,{format:qi,type:kn}):(E.mapPass.width!==E.map.width||E.mapPass.height!==E.map.height)&&E.mapPass.setSize(E.map.width,E.map.height),f.uniforms.shadow_pass.value=E.map.depthTexture,f.uniforms.resolution.value.set(E.map.width,E.map.height),f.uniforms.radius.value=E.radius,n.setRenderTarget(E.mapPass),n.clear(),n.renderBufferDirect(x,null,w,f,_,null),d.uniforms.shadow_pass.value=E.mapPass.texture,d.uniforms.resolution.value.set(E.map.width,E.map.height),d.uniforms.radius.value=E.radius,n.setRenderTarget(E.map),n.clear(),n.renderBufferDirect(x,null,w,d,_,null)}function b(E,x,w,D){let R=null,L=w.isPointLight===!0?E.customDistanceMaterial:E.customDepthMaterial;if(L!==void 0)R=L;else if(R=w.isPointLight===!0?c:a,n.localClippingEnabled&&x.clipShadows===!0&&Array.isArray(x.clippingPlanes)&&x.clippingPlanes.length!==0||x.displacementMap&&x.displacementScale!==0||x.alphaMap&&x.alphaTest>0||x.map&&x.alphaTest>0||x.alphaToCoverage===!0){let I=R.uuid,z=x.uuid,C=l[I];C===void 0&&(C={},l[I]=C);let H=C[z];H===void 0&&(H=R.clone(),C[z]=H,x.addEventListener("dispose",A)),R=H}if(R.visible=x.visible,R.wireframe=x.wireframe,D===Er?R.side=x.shadowSide!==null?x.shadowSide:x.side:R.side=x.shadowSide!==null?x.shadowSide:u[x.side],R.alphaMap=x.alphaMap,R.alphaTest=x.alphaToCoverage===!0?.5:x.alphaTest,R.map=x.map,R.clipShadows=x.clipShadows,R.clippingPlanes=x.clippingPlanes,R.clipIntersection=x.clipIntersection,R.displacementMap=x.displacementMap,R.displacementScale=x.displacementScale,R.displacementBias=x.displacementBias,R.wireframeLinewidth=x.wireframeLinewidth,R.linewidth=x.linewidth,w.isPointLight===!0&&R.isMeshDistanceMaterial===!0){let I=n.properties.get(R);I.light=w}return R}function v(E,x,w,D,R,L){if(E.visible===!1)return;if(E.layers.test(R)&&(E.isMesh||E.isLine||E.isPoints)&&(E.castShadow||E.receiveShadow&&L===Er)&&(!E.frustumCulled||E.intersectsFrustum(i))){E.modelViewMatrix.multiplyMatrices(w.matrixWorldInverse,E.matrixWorld);let C=t.update(E),H=E.material;if(Array.isArray(H)){let q=C.groups;for(let V=0,j=q.length;V<j;V++){let X=q[V],Y=H[X.materialIndex];if(Y&&Y.visible){let st=b(E,Y,D,L);E.onBeforeShadow(n,E,x,w,C,st,X),n.renderBufferDirect(w,null,C,st,E,X),E.onAfterShadow(n,E,x,w,C,st,X)}}}else if(H.visible){let q=b(E,H,D,L);E.onBeforeShadow(n,E,x,w,C,q,null),n.renderBufferDirect(w,null,C,q,E,null),E.onAfterShadow(n,E,x,w,C,q,null)}}let z=E.children;for(let C=0,H=z.length;C<H;C++)v(z[C],x,w,D,R,L)}function A(E){E.target.removeEventListener("dispose",A);for(let w in l){let D=l[w],R=E.target.uuid;R in D&&(D[R].dispose(),delete D[R])}}}function O1(n,t){function e(){let P=!1,tt=new ee,J=null,dt=new ee(0,0,0,0);return{setMask:function(ct){J!==ct&&!P&&(n.colorMask(ct,ct,ct,ct),J=ct)},setLocked:function(ct){P=ct},setClear:function(ct,ut,Tt,Vt,lt){lt===!0&&(ct*=Vt,ut*=Vt,Tt*=Vt),tt.set(ct,ut,Tt,Vt),dt.equals(tt)===!1&&(n.clearColor(ct,ut,Tt,Vt),dt.copy(tt))},reset:function(){P=!1,J=null,dt.set(-1,0,0,0)}}}function i(){let P=!1,tt=!1,J=null,dt=null,ct=null;return{setReversed:function(ut){if(tt!==ut){let Tt=t.get("EXT_clip_control");ut?Tt.clipControlEXT(Tt.LOWER_LEFT_EXT,Tt.ZERO_TO_ONE_EXT):Tt.clipControlEXT(Tt.LOWER_LEFT_EXT,Tt.NEGATIVE_ONE_TO_ONE_EXT),tt=ut;let Vt=ct;ct=null,this.setClear(Vt)}},getReversed:function(){return tt},setTest:function(ut){ut?rt(n.DEPTH_TEST):Mt(n.DEPTH_TEST)},setMask:function(ut){J!==ut&&!P&&(n.depthMask(ut),J=ut)},setFunc:function(ut){if(tt&&(ut=Og[ut]),dt!==ut){switch(ut){case _l:n.depthFunc(n.NEVER);break;case xl:n.depthFunc(n.ALWAYS);break;case yl:n.depthFunc(n.LESS);break;case mr:n.depthFunc(n.LEQUAL);break;case vl:n.depthFunc(n.EQUAL);break;case bl:n.depthFunc(n.GEQUAL);break;case Ml:n.depthFunc(n.GREATER);break;case Sl:n.depthFunc(n.NOTEQUAL);break;default:n.depthFunc(n.LEQUAL)}dt=ut}},setLocked:function(ut){P=ut},setClear:function(ut){ct!==ut&&(ct=ut,tt&&(ut=1-ut),n.clearDepth(ut))},reset:function(){P=!1,J=null,dt=null,ct=null,tt=!1}}}function s(){let P=!1,tt=null,J=null,dt=null,ct=null,ut=null,Tt=null,Vt=null,lt=null;return{setTest:function(Rt){P||(Rt?rt(n.STENCIL_TEST):Mt(n.STENCIL_TEST))},setMask:function(Rt){tt!==Rt&&!P&&(n.stencilMask(Rt),tt=Rt)},setFunc:function(Rt,kt,yt){(J!==Rt||dt!==kt||ct!==yt)&&(n.stencilFunc(Rt,kt,yt),J=Rt,dt=kt,ct=yt)},setOp:function(Rt,kt,yt){(ut!==Rt||Tt!==kt||Vt!==yt)&&(n.stencilOp(Rt,kt,yt),ut=Rt,Tt=kt,Vt=yt)},setLocked:function(Rt){P=Rt},setClear:function(Rt){lt!==Rt&&(n.clearStencil(Rt),lt=Rt)},reset:function(){P=!1,tt=null,J=null,dt=null,ct=null,ut=null,Tt=null,Vt=null,lt=null}}}let r=new e,o=new i,a=new s,c={},l=new WeakMap,h={},u={},f={},d=new WeakMap,g=[],_=null,m=!1,p=null,y=null,b=null,v=null,A=null,E=null,x=null,w=new zt(0,0,0),D=0,R=!1,L=null,I=null,z=null,C=null,H=null,q=n.getParameter(n.MAX_COMBINED_TEXTURE_IMAGE_UNITS),V=!1,j=0,X=n.getParameter(n.VERSION);X.indexOf("WebGL")!==-1?(j=parseFloat(/^WebGL (\d)/.exec(X)[1]),V=j>=1):X.indexOf("OpenGL ES")!==-1&&(j=parseFloat(/^OpenGL ES (\d)/.exec(X)[1]),V=j>=2);let Y=null,st={},O=n.getParameter(n.SCISSOR_BOX),Z=n.getParameter(n.VIEWPORT),B=new ee().fromArray(O),et=new ee().fromArray(Z);function it(P,tt,J,dt){let ct=new Uint8Array(4),ut=n.createTexture();n.bindTexture(P,ut),n.texParameteri(P,n.TEXTURE_MIN_FILTER,n.NEAREST),n.texParameteri(P,n.TEXTURE_MAG_FILTER,n.NEAREST);for(let Tt=0;Tt<J;Tt++)P===n.TEXTURE_3D||P===n.TEXTURE_2D_ARRAY?n.texImage3D(tt,0,n.RGBA,1,1,dt,0,n.RGBA,n.UNSIGNED_BYTE,ct):n.texImage2D(tt+Tt,0,n.RGBA,1,1,0,n.RGBA,n.UNSIGNED_BYTE,ct);return ut}let ot={};ot[n.TEXTURE_2D]=it(n.TEXTURE_2D,n.TEXTURE_2D,1),ot[n.TEXTURE_CUBE_MAP]=it(n.TEXTURE_CUBE_MAP,n.TEXTURE_CUBE_MAP_POSITIVE_X,6),ot[n.TEXTURE_2D_ARRAY]=it(n.TEXTURE_2D_ARRAY,n.TEXTURE_2D_ARRAY,1,1),ot[n.TEXTURE_3D]=it(n.TEXTURE_3D,n.TEXTURE_3D,1,1),r.setClear(0,0,0,1),o.setClear(1),a.setClear(0),rt(n.DEPTH_TEST),o.setFunc(mr),ve(!1),me(Fu),rt(n.CULL_FACE),ue(bs);function rt(P){h[P]!==!0&&(n.enable(P),h[P]=!0)}function Mt(P){h[P]!==!1&&(n.disable(P),h[P]=!1)}function Wt(P,tt){return f[P]!==tt?(n.bindFramebuffer(P,tt),f[P]=tt,P===n.DRAW_FRAMEBUFFER&&(f[n.FRAMEBUFFER]=tt),P===n.FRAMEBUFFER&&(f[n.DRAW_FRAMEBUFFER]=tt),!0):!1}function At(P,tt){let J=g,dt=!1;if(P){J=d.get(tt),J===void 0&&(J=[],d.set(tt,J));let ct=P.textures;if(J.length!==ct.length||J[0]!==n.COLOR_ATTACHMENT0){for(let ut=0,Tt=ct.length;ut<Tt;ut++)J[ut]=n.COLOR_ATTACHMENT0+ut;J.length=ct.length,dt=!0}}else J[0]!==n.BACK&&(J[0]=n.BACK,dt=!0);dt&&n.drawBuffers(J)}function Dt(P){return _!==P?(n.useProgram(P),_=P,!0):!1}let Xt={[Ms]:n.FUNC_ADD,[rg]:n.FUNC_SUBTRACT,[og]:n.FUNC_REVERSE_SUBTRACT};Xt[ag]=n.MIN,Xt[lg]=n.MAX;let Pt={[cg]:n.ZERO,[hg]:n.ONE,[ug]:n.SRC_COLOR,[Vu]:n.SRC_ALPHA,[_g]:n.SRC_ALPHA_SATURATE,[mg]:n.DST_COLOR,[dg]:n.DST_ALPHA,[fg]:n.ONE_MINUS_SRC_COLOR,[Gu]:n.ONE_MINUS_SRC_ALPHA,[gg]:n.ONE_MINUS_DST_COLOR,[pg]:n.ONE_MINUS_DST_ALPHA,[xg]:n.CONSTANT_COLOR,[yg]:n.ONE_MINUS_CONSTANT_COLOR,[vg]:n.CONSTANT_ALPHA,[bg]:n.ONE_MINUS_CONSTANT_ALPHA};function ue(P,tt,J,dt,ct,ut,Tt,Vt,lt,Rt){if(P===bs){m===!0&&(Mt(n.BLEND),m=!1);return}if(m===!1&&(rt(n.BLEND),m=!0),P!==sg){if(P!==p||Rt!==R){if((y!==Ms||A!==Ms)&&(n.blendEquation(n.FUNC_ADD),y=Ms,A=Ms),Rt)switch(P){case Ar:n.blendFuncSeparate(n.ONE,n.ONE_MINUS_SRC_ALPHA,n.ONE,n.ONE_MINUS_SRC_ALPHA);break;case Bu:n.blendFunc(n.ONE,n.ONE);break;case ku:n.blendFuncSeparate(n.ZERO,n.ONE_MINUS_SRC_COLOR,n.ZERO,n.ONE);break;case zu:n.blendFuncSeparate(n.DST_COLOR,n.ONE_MINUS_SRC_ALPHA,n.ZERO,n.ONE);break;default:Nt("WebGLState: Invalid blending: ",P);break}else switch(P){case Ar:n.blendFuncSeparate(n.SRC_ALPHA,n.ONE_MINUS_SRC_ALPHA,n.ONE,n.ONE_MINUS_SRC_ALPHA);break;case Bu:n.blendFuncSeparate(n.SRC_ALPHA,n.ONE,n.ONE,n.ONE);break;case ku:Nt("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case zu:Nt("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:Nt("WebGLState: Invalid blending: ",P);break}b=null,v=null,E=null,x=null,w.set(0,0,0),D=0,p=P,R=Rt}return}ct=ct||tt,ut=ut||J,Tt=Tt||dt,(tt!==y||ct!==A)&&(n.blendEquationSeparate(Xt[tt],Xt[ct]),y=tt,A=ct),(J!==b||dt!==v||ut!==E||Tt!==x)&&(n.blendFuncSeparate(Pt[J],Pt[dt],Pt[ut],Pt[Tt]),b=J,v=dt,E=ut,x=Tt),(Vt.equals(w)===!1||lt!==D)&&(n.blendColor(Vt.r,Vt.g,Vt.b,lt),w.copy(Vt),D=lt),p=P,R=!1}function ae(P,tt){P.side===Sn?Mt(n.CULL_FACE):rt(n.CULL_FACE);let J=P.side===De;tt&&(J=!J),ve(J),P.blending===Ar&&P.transparent===!1?ue(bs):ue(P.blending,P.blendEquation,P.blendSrc,P.blendDst,P.blendEquationAlpha,P.blendSrcAlpha,P.blendDstAlpha,P.blendColor,P.blendAlpha,P.premultipliedAlpha),o.setFunc(P.depthFunc),o.setTest(P.depthTest),o.setMask(P.depthWrite),r.setMask(P.colorWrite);let dt=P.stencilWrite;a.setTest(dt),dt&&(a.setMask(P.stencilWriteMask),a.setFunc(P.stencilFunc,P.stencilRef,P.stencilFuncMask),a.setOp(P.stencilFail,P.stencilZFail,P.stencilZPass)),Ee(P.polygonOffset,P.polygonOffsetFactor,P.polygonOffsetUnits),P.alphaToCoverage===!0?rt(n.SAMPLE_ALPHA_TO_COVERAGE):Mt(n.SAMPLE_ALPHA_TO_COVERAGE)}function ve(P){L!==P&&(P?n.frontFace(n.CW):n.frontFace(n.CCW),L=P)}function me(P){P!==eg?(rt(n.CULL_FACE),P!==I&&(P===Fu?n.cullFace(n.BACK):P===ng?n.cullFace(n.FRONT):n.cullFace(n.FRONT_AND_BACK))):Mt(n.CULL_FACE),I=P}function Vn(P){P!==z&&(V&&n.lineWidth(P),z=P)}function Ee(P,tt,J){P?(rt(n.POLYGON_OFFSET_FILL),(C!==tt||H!==J)&&(C=tt,H=J,o.getReversed()&&(tt=-tt,J=-J),n.polygonOffset(tt,J))):Mt(n.POLYGON_OFFSET_FILL)}function mn(P){P?rt(n.SCISSOR_TEST):Mt(n.SCISSOR_TEST)}function gn(P){P===void 0&&(P=n.TEXTURE0+q-1),Y!==P&&(n.activeTexture(P),Y=P)}function _n(P,tt,J){J===void 0&&(Y===null?J=n.TEXTURE0+q-1:J=Y);let dt=st[J];dt===void 0&&(dt={type:void 0,texture:void 0},st[J]=dt),(dt.type!==P||dt.texture!==tt)&&(Y!==J&&(n.activeTexture(J),Y=J),n.bindTexture(P,tt||ot[P]),dt.type=P,dt.texture=tt)}function F(){let P=st[Y];P!==void 0&&P.type!==void 0&&(n.bindTexture(P.type,null),P.type=void 0,P.texture=void 0)}function xn(){try{n.compressedTexImage2D(...arguments)}catch(P){Nt("WebGLState:",P)}}function fe(){try{n.compressedTexImage3D(...arguments)}catch(P){Nt("WebGLState:",P)}}function de(){try{n.texSubImage2D(...arguments)}catch(P){Nt("WebGLState:",P)}}function xt(){try{n.texSubImage3D(...arguments)}catch(P){Nt("WebGLState:",P)}}function be(){try{n.compressedTexSubImage2D(...arguments)}catch(P){Nt("WebGLState:",P)}}function Lt(){try{n.compressedTexSubImage3D(...arguments)}catch(P){Nt("WebGLState:",P)}}function Ot(){try{n.texStorage2D(...arguments)}catch(P){Nt("WebGLState:",P)}}function T(){try{n.texStorage3D(...arguments)}catch(P){Nt("WebGLState:",P)}}function M(){try{n.texImage2D(...arguments)}catch(P){Nt("WebGLState:",P)}}function G(){try{n.texImage3D(...arguments)}catch(P){Nt("WebGLState:",P)}}function at(P){return u[P]!==void 0?u[P]:n.getParameter(P)}function nt(P,tt){u[P]!==tt&&(n.pixelStorei(P,tt),u[P]=tt)}function ht(P){B.equals(P)===!1&&(n.scissor(P.x,P.y,P.z,P.w),B.copy(P))}function mt(P){et.equals(P)===!1&&(n.viewport(P.x,P.y,P.z,P.w),et.copy(P))}function K(P,tt){let J=l.get(tt);J===void 0&&(J=new WeakMap,l.set(tt,J));let dt=J.get(P);dt===void 0&&(dt=n.getUniformBlockIndex(tt,P.name),n.uniformBlockBinding(tt,dt,dt),J.set(P,dt))}function Q(P,tt,J){let ct=l.get(tt).get(P);c[ct]!==J&&(n.bindBufferBase(n.UNIFORM_BUFFER,ct,J),c[ct]=J)}function ft(){n.disable(n.BLEND),n.disable(n.CULL_FACE),n.disable(n.DEPTH_TEST),n.disable(n.POLYGON_OFFSET_FILL),n.disable(n.SCISSOR_TEST),n.disable(n.STENCIL_TEST),n.disable(n.SAMPLE_ALPHA_TO_COVERAGE),n.blendEquation(n.FUNC_ADD),n.blendFunc(n.ONE,n.ZERO),n.blendFuncSeparate(n.ONE,n.ZERO,n.ONE,n.ZERO),n.blendColor(0,0,0,0),n.colorMask(!0,!0,!0,!0),n.clearColor(0,0,0,0),n.depthMask(!0),n.depthFunc(n.LESS),o.setReversed(!1),n.clearDepth(1),n.stencilMask(4294967295),n.stencilFunc(n.ALWAYS,0,4294967295),n.stencilOp(n.KEEP,n.KEEP,n.KEEP),n.clearStencil(0),n.cullFace(n.BACK),n.frontFace(n.CCW),n.polygonOffset(0,0),n.activeTexture(n.TEXTURE0),n.bindFramebuffer(n.FRAMEBUFFER,null),n.bindFramebuffer(n.DRAW_FRAMEBUFFER,null),n.bindFramebuffer(n.READ_FRAMEBUFFER,null),n.useProgram(null),n.lineWidth(1),n.scissor(0,0,n.canvas.width,n.canvas.height),n.viewport(0,0,n.canvas.width,n.canvas.height),n.pixelStorei(n.PACK_ALIGNMENT,4),n.pixelStorei(n.UNPACK_ALIGNMENT,4),n.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,!1),n.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),n.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,n.BROWSER_DEFAULT_WEBGL),n.pixelStorei(n.PACK_ROW_LENGTH,0),n.pixelStorei(n.PACK_SKIP_PIXELS,0),n.pixelStorei(n.PACK_SKIP_ROWS,0),n.pixelStorei(n.UNPACK_ROW_LENGTH,0),n.pixelStorei(n.UNPACK_IMAGE_HEIGHT,0),n.pixelStorei(n.UNPACK_SKIP_PIXELS,0),n.pixelStorei(n.UNPACK_SKIP_ROWS,0),n.pixelStorei(n.UNPACK_SKIP_IMAGES,0),h={},u={},Y=null,st={},f={},c={},d=new WeakMap,g=[],_=null,m=!1,p=null,y=null,b=null,v=null,A=null,E=null,x=null,w=new zt(0,0,0),D=0,R=!1,L=null,I=null,z=null,C=null,H=null,B.set(0,0,n.canvas.width,n.canvas.height),et.set(0,0,n.canvas.width,n.canvas.height),r.reset(),o.reset(),a.reset()}return{buffers:{color:r,depth:o,stencil:a},enable:rt,disable:Mt,bindFramebuffer:Wt,drawBuffers:At,useProgram:Dt,setBlending:ue,setMaterial:ae,setFlipSided:ve,setCullFace:me,setLineWidth:Vn,setPolygonOffset:Ee,setScissorTest:mn,activeTexture:gn,bindTexture:_n,unbindTexture:F,compressedTexImage2D:xn,compressedTexImage3D:fe,texImage2D:M,texImage3D:G,pixelStorei:nt,getParameter:at,updateUBOMapping:K,uniformBlockBinding:Q,texStorage2D:Ot,texStorage3D:T,texSubImage2D:de,texSubImage3D:xt,compressedTexSubImage2D:be,compressedTexSubImage3D:Lt,scissor:ht,viewport:mt,reset:ft}}function F1(n,t,e,i,s,r,o){let a=t.has("WEBGL_multisampled_render_to_texture")?t.get("WEBGL_multisampled_render_to_texture"):null,c=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),l=new Ct,h=new WeakMap,u=new Set,f,d=new WeakMap,g=new Set,_=new FinalizationRegistry(T=>g.delete(T)),m=!1;try{m=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function p(T,M){return m?new OffscreenCanvas(T,M):fo("canvas")}function y(T,M,G){let at=1,nt=Ot(T);if((nt.width>G||nt.height>G)&&(at=G/Math.max(nt.width,nt.height)),at<1)if(typeof HTMLImageElement<"u"&&T instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&T instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&T instanceof ImageBitmap||typeof VideoFrame<"u"&&T instanceof VideoFrame){let ht=Math.floor(at*nt.width),mt=Math.floor(at*nt.height);f===void 0&&(f=p(ht,mt));let K=M?p(ht,mt):f;return K.width=ht,K.height=mt,K.getContext("2d").drawImage(T,0,0,ht,mt),It("WebGLRenderer: Texture has been resized from ("+nt.width+"x"+nt.height+") to ("+ht+"x"+mt+")."),K}else return"data"in T&&It("WebGLRenderer: Image in DataTexture is too big ("+nt.width+"x"+nt.height+")."),T;return T}function b(T){return T.generateMipmaps}function v(T){n.generateMipmap(T)}function A(T){return T.isWebGLCubeRenderTarget?n.TEXTURE_CUBE_MAP:T.isWebGL3DRenderTarget?n.TEXTURE_3D:T.isWebGLArrayRenderTarget||T.isCompressedArrayTexture?n.TEXTURE_2D_ARRAY:n.TEXTURE_2D}function E(T,M,G,at,nt,ht=!1){if(T!==null){if(n[T]!==void 0)return n[T];It("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+T+"'")}let mt;at&&(mt=t.get("EXT_texture_norm16"),mt||It("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let K=M;if(M===n.RED&&(G===n.FLOAT&&(K=n.R32F),G===n.HALF_FLOAT&&(K=n.R16F),G===n.UNSIGNED_BYTE&&(K=n.R8),G===n.UNSIGNED_SHORT&&mt&&(K=mt.R16_EXT),G===n.SHORT&&mt&&(K=mt.R16_SNORM_EXT)),M===n.RED_INTEGER&&(G===n.UNSIGNED_BYTE&&(K=n.R8UI),G===n.UNSIGNED_SHORT&&(K=n.R16UI),G===n.UNSIGNED_INT&&(K=n.R32UI),G===n.BYTE&&(K=n.R8I),G===n.SHORT&&(K=n.R16I),G===n.INT&&(K=n.R32I)),M===n.RG&&(G===n.FLOAT&&(K=n.RG32F),G===n.HALF_FLOAT&&(K=n.RG16F),G===n.UNSIGNED_BYTE&&(K=n.RG8),G===n.UNSIGNED_SHORT&&mt&&(K=mt.RG16_EXT),G===n.SHORT&&mt&&(K=mt.RG16_SNORM_EXT)),M===n.RG_INTEGER&&(G===n.UNSIGNED_BYTE&&(K=n.RG8UI),G===n.UNSIGNED_SHORT&&(K=n.RG16UI),G===n.UNSIGNED_INT&&(K=n.RG32UI),G===n.BYTE&&(K=n.RG8I),G===n.SHORT&&(K=n.RG16I),G===n.INT&&(K=n.RG32I)),M===n.RGB_INTEGER&&(G===n.UNSIGNED_BYTE&&(K=n.RGB8UI),G===n.UNSIGNED_SHORT&&(K=n.RGB16UI),G===n.UNSIGNED_INT&&(K=n.RGB32UI),G===n.BYTE&&(K=n.RGB8I),G===n.SHORT&&(K=n.RGB16I),G===n.INT&&(K=n.RGB32I)),M===n.RGBA_INTEGER&&(G===n.UNSIGNED_BYTE&&(K=n.RGBA8UI),G===n.UNSIGNED_SHORT&&(K=n.RGBA16UI),G===n.UNSIGNED_INT&&(K=n.RGBA32UI),G===n.BYTE&&(K=n.RGBA8I),G===n.SHORT&&(K=n.RGBA16I),G===n.INT&&(K=n.RGBA32I)),M===n.RGB&&(G===n.UNSIGNED_SHORT&&mt&&(K=mt.RGB16_EXT),G===n.SHORT&&mt&&(K=mt.RGB16_SNORM_EXT),G===n.UNSIGNED_INT_5_9_9_9_REV&&(K=n.RGB9_E5),G===n.UNSIGNED_INT_10F_11F_11F_REV&&(K=n.R11F_G11F_B10F)),M===n.RGBA){let Q=ht?uo:Yt.getTransfer(nt);G===n.FLOAT&&(K=n.RGBA32F),G===n.HALF_FLOAT&&(K=n.RGBA16F),G===n.UNSIGNED_BYTE&&(K=Q===te?n.SRGB8_ALPHA8:n.RGBA8),G===n.UNSIGNED_SHORT&&mt&&(K=mt.RGBA16_EXT),G===n.SHORT&&mt&&(K=mt.RGBA16_SNORM_EXT),G===n.UNSIGNED_SHORT_4_4_4_4&&(K=n.RGBA4),G===n.UNSIGNED_SHORT_5_5_5_1&&(K=n.RGB5_A1)}return(K===n.R16F||K===n.R32F||K===n.RG16F||K===n.RG32F||K===n.RGBA16F||K===n.RGBA32F)&&t.get("EXT_color_buffer_float"),K}function x(T,M){let G;return T?M===null||M===Fn||M===ws?G=n.DEPTH24_STENCIL8:M===Bn?G=n.DEPTH32F_STENCIL8:M===Cr&&(G=n.DEPTH24_STENCIL8,It("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):M===null||M===Fn||M===ws?G=n.DEPTH_COMPONENT24:M===Bn?G=n.DEPTH_COMPONENT32F:M===Cr&&(G=n.DEPTH_COMPONENT16),G}function w(T,M){return b(T)===!0||T.isFramebufferTexture&&T.minFilter!==Ie&&T.minFilter!==Qe?Math.log2(Math.max(M.width,M.height))+1:T.mipmaps.length>0?T.mipmaps.length:T.isCompressedTexture&&Array.isArray(T.image)?M.mipmaps.length:1}function D(T){let M=new WeakRef(T);i.get(T).__ref=M,g.add(M),_.register(T,M,M)}function R(T){let M=i.get(T).__ref;M!==void 0&&(g.delete(M),_.unregister(M))}function L(T){z(T.target)}function I(T){C(T.target)}function z(T){T.removeEventListener("dispose",L),R(T),q(T),T.isVideoTexture&&h.delete(T),T.isHTMLTexture&&u.delete(T)}function C(T){T.removeEventListener("dispose",I),R(T),j(T)}function H(){for(let T of g){let M=T.deref();M!==void 0&&(M.isRenderTarget===!0?C(M):z(M))}g.clear(),u.clear()}function q(T){let M=i.get(T);if(M.__webglInit===void 0)return;let G=T.source,at=d.get(G);if(at){let nt=at[M.__cacheKey];nt.usedTimes--,nt.usedTimes===0&&V(T),Object.keys(at).length===0&&d.delete(G)}i.remove(T)}function V(T){let M=i.get(T);n.deleteTexture(M.__webglTexture);let G=T.source,at=d.get(G);delete at[M.__cacheKey],o.memory.textures--}function j(T){let M=i.get(T);M.__depthDisposeCallback&&M.__depthDisposeCallback();let G=T.depthTexture;if(G&&G.renderTarget===T&&z(G),T.isWebGLCubeRenderTarget)for(let nt=0;nt<6;nt++){if(Array.isArray(M.__webglFramebuffer[nt]))for(let ht=0;ht<M.__webglFramebuffer[nt].length;ht++)n.deleteFramebuffer(M.__webglFramebuffer[nt][ht]);else n.deleteFramebuffer(M.__webglFramebuffer[nt]);M.__webglDepthbuffer&&n.deleteRenderbuffer(M.__webglDepthbuffer[nt])}else{if(Array.isArray(M.__webglFramebuffer))for(let nt=0;nt<M.__webglFramebuffer.length;nt++)n.deleteFramebuffer(M.__webglFramebuffer[nt]);else n.deleteFramebuffer(M.__webglFramebuffer);if(M.__webglDepthbuffer&&n.deleteRenderbuffer(M.__webglDepthbuffer),M.__webglMultisampledFramebuffer&&n.deleteFramebuffer(M.__webglMultisampledFramebuffer),M.__webglColorRenderbuffer)for(let nt=0;nt<M.__webglColorRenderbuffer.length;nt++)M.__webglColorRenderbuffer[nt]&&n.deleteRenderbuffer(M.__webglColorRenderbuffer[nt]);M.__webglDepthRenderbuffer&&n.deleteRenderbuffer(M.__webglDepthRenderbuffer)}let at=T.textures;for(let nt=0,ht=at.length;nt<ht;nt++){let mt=i.get(at[nt]);mt.__webglTexture&&(n.deleteTexture(mt.__webglTexture),o.memory.textures--),i.remove(at[nt])}i.remove(T)}let X=0;function Y(){X=0}function st(){return X}function O(T){X=T}function Z(){let T=X;return T>=s.maxTextures&&It("WebGLTextures: Trying to use "+(T+1)+" texture units while this GPU supports only "+s.maxTextures),X+=1,T}function B(T){let M=[];return M.push(T.wrapS),M.push(T.wrapT),M.push(T.wrapR||0),M.push(T.magFilter),M.push(T.minFilter),M.push(T.anisotropy),M.push(T.internalFormat),M.push(T.format),M.push(T.type),M.push(T.generateMipmaps),M.push(T.mipmapsAutoUpdate),M.push(T.premultiplyAlpha),M.push(T.flipY),M.push(T.unpackAlignment),M.push(T.colorSpace),M.join()}function et(T,M){let G=i.get(T);if(T.isVideoTexture&&be(T),T.isRenderTargetTexture===!1&&T.isExternalTexture!==!0&&T.version>0&&G.__version!==T.version){let at=T.image;if(at===null)It("WebGLRenderer: Texture marked for update but no image data found.");else if(at.complete===!1)It("WebGLRenderer: Texture marked for update but image is incomplete");else{ae(G,T,M);return}}else T.isExternalTexture&&(G.__webglTexture=T.sourceTexture?T.sourceTexture:null);e.bindTexture(n.TEXTURE_2D,G.__webglTexture,n.TEXTURE0+M)}function it(T,M){let G=i.get(T);if(T.isRenderTargetTexture===!1&&T.version>0&&G.__version!==T.version){ae(G,T,M);return}else T.isExternalTexture&&(G.__webglTexture=T.sourceTexture?T.sourceTexture:null);e.bindTexture(n.TEXTURE_2D_ARRAY,G.__webglTexture,n.TEXTURE0+M)}function ot(T,M){let G=i.get(T);if(T.isRenderTargetTexture===!1&&T.version>0&&G.__version!==T.version){ae(G,T,M);return}e.bindTexture(n.TEXTURE_3D,G.__webglTexture,n.TEXTURE0+M)}function rt(T,M){let G=i.get(T);if(T.version>0&&G.__version!==T.version){ve(G,T,M);return}e.bindTexture(n.TEXTURE_CUBE_MAP,G.__webglTexture,n.TEXTURE0+M)}let Mt={[wl]:n.REPEAT,[qn]:n.CLAMP_TO_EDGE,[El]:n.MIRRORED_REPEAT},Wt={[Ie]:n.NEAREST,[wg]:n.NEAREST_MIPMAP_NEAREST,[Fo]:n.NEAREST_MIPMAP_LINEAR,[Qe]:n.LINEAR,[tc]:n.LINEAR_MIPMAP_NEAREST,[wi]:n.LINEAR_MIPMAP_LINEAR},At={[Cg]:n.NEVER,[af]:n.ALWAYS,[Rg]:n.LESS,[rf]:n.LEQUAL,[Pg]:n.EQUAL,[of]:n.GEQUAL,[Ig]:n.GREATER,[Lg]:n.NOTEQUAL};function Dt(T,M){if(M.type===Bn&&t.has("OES_texture_float_linear")===!1&&(M.magFilter===Qe||M.magFilter===tc||M.magFilter===Fo||M.magFilter===wi||M.minFilter===Qe||M.minFilter===tc||M.minFilter===Fo||M.minFilter===wi)&&It("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),n.texParameteri(T,n.TEXTURE_WRAP_S,Mt[M.wrapS]),n.texParameteri(T,n.TEXTURE_WRAP_T,Mt[M.wrapT]),(T===n.TEXTURE_3D||T===n.TEXTURE_2D_ARRAY)&&n.texParameteri(T,n.TEXTURE_WRAP_R,Mt[M.wrapR]),n.texParameteri(T,n.TEXTURE_MAG_FILTER,Wt[M.magFilter]),n.texParameteri(T,n.TEXTURE_MIN_FILTER,Wt[M.minFilter]),M.compareFunction&&(n.texParameteri(T,n.TEXTURE_COMPARE_MODE,n.COMPARE_REF_TO_TEXTURE),n.texParameteri(T,n.TEXTURE_COMPARE_FUNC,At[M.compareFunction])),t.has("EXT_texture_filter_anisotropic")===!0){if(M.magFilter===Ie||M.minFilter!==Fo&&M.minFilter!==wi||M.type===Bn&&t.has("OES_texture_float_linear")===!1)return;if(M.anisotropy>1||i.get(M).__currentAnisotropy){let G=t.get("EXT_texture_filter_anisotropic");n.texParameterf(T,G.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(M.anisotropy,s.getMaxAnisotropy())),i.get(M).__currentAnisotropy=M.anisotropy}}}function Xt(T,M){let G=!1;T.__webglInit===void 0&&(T.__webglInit=!0,M.addEventListener("dispose",L),D(M));let at=M.source,nt=d.get(at);nt===void 0&&(nt={},d.set(at,nt));let ht=B(M);if(ht!==T.__cacheKey){nt[ht]===void 0&&(nt[ht]={texture:n.createTexture(),usedTimes:0},o.memory.textures++,G=!0),nt[ht].usedTimes++;let mt=nt[T.__cacheKey];mt!==void 0&&(nt[T.__cacheKey].usedTimes--,mt.usedTimes===0&&V(M)),T.__cacheKey=ht,T.__webglTexture=nt[ht].texture}return G}function Pt(T,M,G){return Math.floor(Math.floor(T/G)/M)}function ue(T,M,G,at){let ht=T.updateRanges;if(ht.length===0)e.texSubImage2D(n.TEXTURE_2D,0,0,0,M.width,M.height,G,at,M.data);else{ht.sort((P,tt)=>P.start-tt.start);let mt=0;for(let P=1;P<ht.length;P++){let tt=ht[mt],J=ht[P],dt=tt.start+tt.count,ct=Pt(J.start,M.width,4),ut=Pt(tt.start,M.width,4);J.start<=dt+1&&ct===ut&&Pt(J.start+J.count-1,M.width,4)===ct?tt.count=Math.max(tt.count,J.start+J.count-tt.start):(++mt,ht[mt]=J)}ht.length=mt+1;let K=e.getParameter(n.UNPACK_ROW_LENGTH),Q=e.getParameter(n.UNPACK_SKIP_PIXELS),ft=e.getParameter(n.UNPACK_SKIP_ROWS);e.pixelStorei(n.UNPACK_ROW_LENGTH,M.width);for(let P=0,tt=ht.length;P<tt;P++){let J=ht[P],dt=Math.floor(J.start/4),ct=Math.ceil(J.count/4),ut=dt%M.width,Tt=Math.floor(dt/M.width),Vt=ct,lt=1;e.pixelStorei(n.UNPACK_SKIP_PIXELS,ut),e.pixelStorei(n.UNPACK_SKIP_ROWS,Tt),e.texSubImage2D(n.TEXTURE_2D,0,ut,Tt,Vt,lt,G,at,M.data)}T.clearUpdateRanges(),e.pixelStorei(n.UNPACK_ROW_LENGTH,K),e.pixelStorei(n.UNPACK_SKIP_PIXELS,Q),e.pixelStorei(n.UNPACK_SKIP_ROWS,ft)}}function ae(T,M,G){let at=n.TEXTURE_2D;(M.isDataArrayTexture||M.isCompressedArrayTexture)&&(at=n.TEXTURE_2D_ARRAY),M.isData3DTexture&&(at=n.TEXTURE_3D);let nt=Xt(T,M),ht=M.source;e.bindTexture(at,T.__webglTexture,n.TEXTURE0+G);let mt=i.get(ht);if(ht.version!==mt.__version||nt===!0){if(e.activeTexture(n.TEXTURE0+G),(typeof ImageBitmap<"u"&&M.image instanceof ImageBitmap)===!1){let lt=Yt.getPrimaries(Yt.workingColorSpace),Rt=M.colorSpace===Ai?null:Yt.getPrimaries(M.colorSpace),kt=M.colorSpace===Ai||lt===Rt?n.NONE:n.BROWSER_DEFAULT_WEBGL;e.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,M.flipY),e.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,M.premultiplyAlpha),e.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,kt)}e.pixelStorei(n.UNPACK_ALIGNMENT,M.unpackAlignment);let Q=y(M.image,!1,s.maxTextureSize);Q=Lt(M,Q);let ft=r.convert(M.format,M.colorSpace),P=r.convert(M.type),tt=E(M.internalFormat,ft,P,M.normalized,M.colorSpace,M.isVideoTexture);Dt(at,M);let J,dt=M.mipmaps,ct=M.isVideoTexture!==!0,ut=mt.__version===void 0||nt===!0,Tt=ht.dataReady,Vt=w(M,Q);if(M.isDepthTexture)tt=x(M.format===Ei,M.type),ut&&(ct?e.texStorage2D(n.TEXTURE_2D,1,tt,Q.width,Q.height):e.texImage2D(n.TEXTURE_2D,0,tt,Q.width,Q.height,0,ft,P,null));else if(M.isDataTexture)if(dt.length>0){ct&&ut&&e.texStorage2D(n.TEXTURE_2D,Vt,tt,dt[0].width,dt[0].height);for(let lt=0,Rt=dt.length;lt<Rt;lt++)J=dt[lt],ct?Tt&&e.texSubImage2D(n.TEXTURE_2D,lt,0,0,J.width,J.height,ft,P,J.data):e.texImage2D(n.TEXTURE_2D,lt,tt,J.width,J.height,0,ft,P,J.data);M.generateMipmaps=!1}else ct?(ut&&e.texStorage2D(n.TEXTURE_2D,Vt,tt,Q.width,Q.height),Tt&&ue(M,Q,ft,P)):e.texImage2D(n.TEXTURE_2D,0,tt,Q.width,Q.height,0,ft,P,Q.data);else if(M.isCompressedTexture)if(M.isCompressedArrayTexture){ct&&ut&&e.texStorage3D(n.TEXTURE_2D_ARRAY,Vt,tt,dt[0].width,dt[0].height,Q.depth);for(let lt=0,Rt=dt.length;lt<Rt;lt++)if(J=dt[lt],M.format!==zn)if(ft!==null)if(ct){if(Tt)if(M.layerUpdates.size>0){let kt=_f(J.width,J.height,M.format,M.type);for(let yt of M.layerUpdates){let ne=J.data.subarray(yt*kt/J.data.BYTES_PER_ELEMENT,(yt+1)*kt/J.data.BYTES_PER_ELEMENT);e.compressedTexSubImage3D(n.TEXTURE_2D_ARRAY,lt,0,0,yt,J.width,J.height,1,ft,ne)}}else e.compressedTexSubImage3D(n.TEXTURE_2D_ARRAY,lt,0,0,0,J.width,J.height,Q.depth,ft,J.data)}else e.compressedTexImage3D(n.TEXTURE_2D_ARRAY,lt,tt,J.width,J.height,Q.depth,0,J.data,0,0);else It("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else ct?Tt&&e.texSubImage3D(n.TEXTURE_2D_ARRAY,lt,0,0,0,J.width,J.height,Q.depth,ft,P,J.data):e.texImage3D(n.TEXTURE_2D_ARRAY,lt,tt,J.width,J.height,Q.depth,0,ft,P,J.data);M.layerUpdates.size>0&&M.clearLayerUpdates()}else{ct&&ut&&e.texStorage2D(n.TEXTURE_2D,Vt,tt,dt[0].width,dt[0].height);for(let lt=0,Rt=dt.length;lt<Rt;lt++)J=dt[lt],M.format!==zn?ft!==null?ct?Tt&&e.compressedTexSubImage2D(n.TEXTURE_2D,lt,0,0,J.width,J.height,ft,J.data):e.compressedTexImage2D(n.TEXTURE_2D,lt,tt,J.width,J.height,0,J.data):It("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):ct?Tt&&e.texSubImage2D(n.TEXTURE_2D,lt,0,0,J.width,J.height,ft,P,J.data):e.texImage2D(n.TEXTURE_2D,lt,tt,J.width,J.height,0,ft,P,J.data)}else if(M.isDataArrayTexture)if(ct){if(ut&&e.texStorage3D(n.TEXTURE_2D_ARRAY,Vt,tt,Q.width,Q.height,Q.depth),Tt)if(M.layerUpdates.size>0){let lt=_f(Q.width,Q.height,M.format,M.type);for(let Rt of M.layerUpdates){let kt=Q.data.subarray(Rt*lt/Q.data.BYTES_PER_ELEMENT,(Rt+1)*lt/Q.data.BYTES_PER_ELEMENT);e.texSubImage3D(n.TEXTURE_2D_ARRAY,0,0,0,Rt,Q.width,Q.height,1,ft,P,kt)}M.clearLayerUpdates()}else e.texSubImage3D(n.TEXTURE_2D_ARRAY,0,0,0,0,Q.width,Q.height,Q.depth,ft,P,Q.data)}else e.texImage3D(n.TEXTURE_2D_ARRAY,0,tt,Q.width,Q.height,Q.depth,0,ft,P,Q.data);else if(M.isData3DTexture)ct?(ut&&e.texStorage3D(n.TEXTURE_3D,Vt,tt,Q.width,Q.height,Q.depth),Tt&&e.texSubImage3D(n.TEXTURE_3D,0,0,0,0,Q.width,Q.height,Q.depth,ft,P,Q.data)):e.texImage3D(n.TEXTURE_3D,0,tt,Q.width,Q.height,Q.depth,0,ft,P,Q.data);else if(M.isFramebufferTexture){if(ut)if(ct)e.texStorage2D(n.TEXTURE_2D,Vt,tt,Q.width,Q.height);else{let lt=Q.width,Rt=Q.height;for(let kt=0;kt<Vt;kt++)e.texImage2D(n.TEXTURE_2D,kt,tt,lt,Rt,0,ft,P,null),lt>>=1,Rt>>=1}}else if(M.isHTMLTexture){if("texElementImage2D"in n){let lt=n.canvas;if(lt.hasAttribute("layoutsubtree")||lt.setAttribute("layoutsubtree","true"),Q.parentNode!==lt){lt.appendChild(Q),u.add(M),lt.onpaint=Rt=>{let kt=Rt.changedElements;for(let yt of u)kt.includes(yt.image)&&(yt.needsUpdate=!0)},lt.requestPaint();return}if(n.texElementImage2D.length===3)n.texElementImage2D(n.TEXTURE_2D,n.RGBA8,Q);else{let kt=n.RGBA,yt=n.RGBA,ne=n.UNSIGNED_BYTE;n.texElementImage2D(n.TEXTURE_2D,0,kt,yt,ne,Q)}n.texParameteri(n.TEXTURE_2D,n.TEXTURE_MIN_FILTER,n.LINEAR),n.texParameteri(n.TEXTURE_2D,n.TEXTURE_WRAP_S,n.CLAMP_TO_EDGE),n.texParameteri(n.TEXTURE_2D,n.TEXTURE_WRAP_T,n.CLAMP_TO_EDGE)}}else if(dt.length>0){if(ct&&ut){let lt=Ot(dt[0]);e.texStorage2D(n.TEXTURE_2D,Vt,tt,lt.width,lt.height)}for(let lt=0,Rt=dt.length;lt<Rt;lt++)J=dt[lt],ct?Tt&&e.texSubImage2D(n.TEXTURE_2D,lt,0,0,ft,P,J):e.texImage2D(n.TEXTURE_2D,lt,tt,ft,P,J);M.generateMipmaps=!1}else if(ct){if(ut){let lt=Ot(Q);e.texStorage2D(n.TEXTURE_2D,Vt,tt,lt.width,lt.height)}Tt&&e.texSubImage2D(n.TEXTURE_2D,0,0,0,ft,P,Q)}else e.texImage2D(n.TEXTURE_2D,0,tt,ft,P,Q);b(M)&&M.mipmapsAutoUpdate===!0&&v(at),mt.__version=ht.version,M.onUpdate&&M.onUpdate(M)}T.__version=M.version}function ve(T,M,G){if(M.image.length!==6)return;let at=Xt(T,M),nt=M.source;e.bindTexture(n.TEXTURE_CUBE_MAP,T.__webglTexture,n.TEXTURE0+G);let ht=i.get(nt);if(nt.version!==ht.__version||at===!0){e.activeTexture(n.TEXTURE0+G);let mt=Yt.getPrimaries(Yt.workingColorSpace),K=M.colorSpace===Ai?null:Yt.getPrimaries(M.colorSpace),Q=M.colorSpace===Ai||mt===K?n.NONE:n.BROWSER_DEFAULT_WEBGL;e.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,M.flipY),e.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,M.premultiplyAlpha),e.pixelStorei(n.UNPACK_ALIGNMENT,M.unpackAlignment),e.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,Q);let ft=M.isCompressedTexture||M.image[0].isCompressedTexture,P=M.image[0]&&M.image[0].isDataTexture,tt=[];for(let yt=0;yt<6;yt++)!ft&&!P?tt[yt]=y(M.image[yt],!0,s.maxCubemapSize):tt[yt]=P?M.image[yt].image:M.image[yt],tt[yt]=Lt(M,tt[yt]);let J=tt[0],dt=r.convert(M.format,M.colorSpace),ct=r.convert(M.type),ut=E(M.internalFormat,dt,ct,M.normalized,M.colorSpace),Tt=M.isVideoTexture!==!0,Vt=ht.__version===void 0||at===!0,lt=nt.dataReady,Rt=w(M,J);Dt(n.TEXTURE_CUBE_MAP,M);let kt;if(M.isDepthTexture){if(ut=x(M.format===Ei,M.type),Vt)if(Tt)e.texStorage2D(n.TEXTURE_CUBE_MAP,1,ut,J.width,J.height);else for(let yt=0;yt<6;yt++)e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+yt,0,ut,J.width,J.height,0,dt,ct,null)}else if(ft){Tt&&Vt&&e.texStorage2D(n.TEXTURE_CUBE_MAP,Rt,ut,J.width,J.height);for(let yt=0;yt<6;yt++){kt=tt[yt].mipmaps;for(let ne=0;ne<kt.length;ne++){let Ae=kt[ne];M.format!==zn?dt!==null?Tt?lt&&e.compressedTexSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+yt,ne,0,0,Ae.width,Ae.height,dt,Ae.data):e.compressedTexImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+yt,ne,ut,Ae.width,Ae.height,0,Ae.data):It("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):Tt?lt&&e.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+yt,ne,0,0,Ae.width,Ae.height,dt,ct,Ae.data):e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+yt,ne,ut,Ae.width,Ae.height,0,dt,ct,Ae.data)}}}else{if(kt=M.mipmaps,Tt&&Vt){kt.length>0&&Rt++;let yt=Ot(tt[0]);e.texStorage2D(n.TEXTURE_CUBE_MAP,Rt,ut,yt.width,yt.height)}for(let yt=0;yt<6;yt++)if(P){Tt?lt&&e.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+yt,0,0,0,tt[yt].width,tt[yt].height,dt,ct,tt[yt].data):e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+yt,0,ut,tt[yt].width,tt[yt].height,0,dt,ct,tt[yt].data);for(let ne=0;ne<kt.length;ne++){let Ti=kt[ne].image[yt].image;Tt?lt&&e.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+yt,ne+1,0,0,Ti.width,Ti.height,dt,ct,Ti.data):e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+yt,ne+1,ut,Ti.width,Ti.height,0,dt,ct,Ti.data)}}else{Tt?lt&&e.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+yt,0,0,0,dt,ct,tt[yt]):e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+yt,0,ut,dt,ct,tt[yt]);for(let ne=0;ne<kt.length;ne++){let Ae=kt[ne];Tt?lt&&e.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+yt,ne+1,0,0,dt,ct,Ae.image[yt]):e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+yt,ne+1,ut,dt,ct,Ae.image[yt])}}}b(M)&&M.mipmapsAutoUpdate===!0&&v(n.TEXTURE_CUBE_MAP),ht.__version=nt.version,M.onUpdate&&M.onUpdate(M)}T.__version=M.version}function me(T,M,G,at,nt,ht){let mt=r.convert(G.format,G.colorSpace),K=r.convert(G.type),Q=E(G.internalFormat,mt,K,G.normalized,G.colorSpace),ft=i.get(M),P=i.get(G);if(P.__renderTarget=M,!ft.__hasExternalTextures){let tt=Math.max(1,M.width>>ht),J=Math.max(1,M.height>>ht);nt===n.TEXTURE_3D||nt===n.TEXTURE_2D_ARRAY?e.texImage3D(nt,ht,Q,tt,J,M.depth,0,mt,K,null):e.texImage2D(nt,ht,Q,tt,J,0,mt,K,null)}e.bindFramebuffer(n.FRAMEBUFFER,T),xt(M)?a.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,at,nt,P.__webglTexture,0,de(M)):(nt===n.TEXTURE_2D||nt>=n.TEXTURE_CUBE_MAP_POSITIVE_X&&nt<=n.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&n.framebufferTexture2D(n.FRAMEBUFFER,at,nt,P.__webglTexture,ht),e.bindFramebuffer(n.FRAMEBUFFER,null)}function Vn(T,M,G){if(n.bindRenderbuffer(n.RENDERBUFFER,T),M.depthBuffer){let at=M.depthTexture,nt=at&&at.isDepthTexture?at.type:null,ht=x(M.stencilBuffer,nt),mt=M.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;xt(M)?a.renderbufferStorageMultisampleEXT(n.RENDERBUFFER,de(M),ht,M.width,M.height):G?n.renderbufferStorageMultisample(n.RENDERBUFFER,de(M),ht,M.width,M.height):n.renderbufferStorage(n.RENDERBUFFER,ht,M.width,M.height),n.framebufferRenderbuffer(n.FRAMEBUFFER,mt,n.RENDERBUFFER,T)}else{let at=M.textures;for(let nt=0;nt<at.length;nt++){let ht=at[nt],mt=r.convert(ht.format,ht.colorSpace),K=r.convert(ht.type),Q=E(ht.internalFormat,mt,K,ht.normalized,ht.colorSpace);xt(M)?a.renderbufferStorageMultisampleEXT(n.RENDERBUFFER,de(M),Q,M.width,M.height):G?n.renderbufferStorageMultisample(n.RENDERBUFFER,de(M),Q,M.width,M.height):n.renderbufferStorage(n.RENDERBUFFER,Q,M.width,M.height)}}n.bindRenderbuffer(n.RENDERBUFFER,null)}function Ee(T,M,G){let at=M.isWebGLCubeRenderTarget===!0;if(e.bindFramebuffer(n.FRAMEBUFFER,T),!(M.depthTexture&&M.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let nt=i.get(M.depthTexture);nt.__renderTarget=M;let ht=at?M.depthTexture.image[0]:M.depthTexture.image;(!nt.__webglTexture||ht.width!==M.width||ht.height!==M.height)&&(ht.width=M.width,ht.height=M.height,M.depthTexture.needsUpdate=!0),at?rt(M.depthTexture,0):et(M.depthTexture,0);let mt=nt.__webglTexture,K=de(M),Q=at?n.TEXTURE_CUBE_MAP_POSITIVE_X+G:n.TEXTURE_2D,ft=M.depthTexture.format===Ei?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;if(M.depthTexture.format===xi)xt(M)?a.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,ft,Q,mt,0,K):n.framebufferTexture2D(n.FRAMEBUFFER,ft,Q,mt,0);else if(M.depthTexture.format===Ei)xt(M)?a.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,ft,Q,mt,0,K):n.framebufferTexture2D(n.FRAMEBUFFER,ft,Q,mt,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function mn(T){let M=i.get(T),G=T.isWebGLCubeRenderTarget===!0;if(M.__boundDepthTexture!==T.depthTexture){let at=T.depthTexture;if(M.__depthDisposeCallback&&M.__depthDisposeCallback(),at){let nt=()=>{delete M.__boundDepthTexture,delete M.__depthDisposeCallback,at.removeEventListener("dispose",nt)};at.addEventListener("dispose",nt),M.__depthDisposeCallback=nt}M.__boundDepthTexture=at}if(T.depthTexture&&!M.__autoAllocateDepthBuffer)if(G)for(let at=0;at<6;at++)Ee(M.__webglFramebuffer[at],T,at);else T.texture.mipmaps.length>0?Ee(M.__webglFramebuffer[0],T,0):Ee(M.__webglFramebuffer,T,0);else if(G){M.__webglDepthbuffer=[];for(let at=0;at<6;at++)if(e.bindFramebuffer(n.FRAMEBUFFER,M.__webglFramebuffer[at]),M.__webglDepthbuffer[at]===void 0)M.__webglDepthbuffer[at]=n.createRenderbuffer(),Vn(M.__webglDepthbuffer[at],T,!1);else{let nt=T.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,ht=M.__webglDepthbuffer[at];n.bindRenderbuffer(n.RENDERBUFFER,ht),n.framebufferRenderbuffer(n.FRAMEBUFFER,nt,n.RENDERBUFFER,ht)}}else if(T.texture.mipmaps.length>0?e.bindFramebuffer(n.FRAMEBUFFER,M.__webglFramebuffer[0]):e.bindFramebuffer(n.FRAMEBUFFER,M.__webglFramebuffer),M.__webglDepthbuffer===void 0)M.__webglDepthbuffer=n.createRenderbuffer(),Vn(M.__webglDepthbuffer,T,!1);else{let nt=T.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,ht=M.__webglDepthbuffer;n.bindRenderbuffer(n.RENDERBUFFER,ht),n.framebufferRenderbuffer(n.FRAMEBUFFER,nt,n.RENDERBUFFER,ht)}e.bindFramebuffer(n.FRAMEBUFFER,null)}function gn(T,M,G){let at=i.get(T);M!==void 0&&me(at.__webglFramebuffer,T,T.texture,n.COLOR_ATTACHMENT0,n.TEXTURE_2D,0),G!==void 0&&mn(T)}function _n(T){let M=T.texture,G=i.get(T),at=i.get(M);T.addEventListener("dispose",I),D(T);let nt=T.textures,ht=T.isWebGLCubeRenderTarget===!0,mt=nt.length>1;if(mt||(at.__webglTexture===void 0&&(at.__webglTexture=n.createTexture()),at.__version=M.version,o.memory.textures++),ht){G.__webglFramebuffer=[];for(let K=0;K<6;K++)if(M.mipmaps.length>0){G.__webglFramebuffer[K]=[];for(let Q=0;Q<M.mipmaps.length;Q++)G.__webglFramebuffer[K][Q]=n.createFramebuffer()}else G.__webglFramebuffer[K]=n.createFramebuffer()}else{if(M.mipmaps.length>0){G.__webglFramebuffer=[];for(let K=0;K<M.mipmaps.length;K++)G.__webglFramebuffer[K]=n.createFramebuffer()}else G.__webglFramebuffer=n.createFramebuffer();if(mt)for(let K=0,Q=nt.length;K<Q;K++){let ft=i.get(nt[K]);ft.__webglTexture===void 0&&(ft.__webglTexture=n.createTexture(),o.memory.textures++)}if(T.samples>0&&xt(T)===!1){G.__webglMultisampledFramebuffer=n.createFramebuffer(),G.__webglColorRenderbuffer=[],e.bindFramebuffer(n.FRAMEBUFFER,G.__webglMultisampledFramebuffer);for(let K=0;K<nt.length;K++){let Q=nt[K];G.__webglColorRenderbuffer[K]=n.createRenderbuffer(),n.bindRenderbuffer(n.RENDERBUFFER,G.__webglColorRenderbuffer[K]);let ft=r.convert(Q.format,Q.colorSpace),P=r.convert(Q.type),tt=E(Q.internalFormat,ft,P,Q.normalized,Q.colorSpace,T.isXRRenderTarget===!0),J=de(T);n.renderbufferStorageMultisample(n.RENDERBUFFER,J,tt,T.width,T.height),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+K,n.RENDERBUFFER,G.__webglColorRenderbuffer[K])}n.bindRenderbuffer(n.RENDERBUFFER,null),T.depthBuffer&&(G.__webglDepthRenderbuffer=n.createRenderbuffer(),Vn(G.__webglDepthRenderbuffer,T,!0)),e.bindFramebuffer(n.FRAMEBUFFER,null)}}if(ht){e.bindTexture(n.TEXTURE_CUBE_MAP,at.__webglTexture),Dt(n.TEXTURE_CUBE_MAP,M);for(let K=0;K<6;K++)if(M.mipmaps.length>0)for(let Q=0;Q<M.mipmaps.length;Q++)me(G.__webglFramebuffer[K][Q],T,M,n.COLOR_ATTACHMENT0,n.TEXTURE_CUBE_MAP_POSITIVE_X+K,Q);else me(G.__webglFramebuffer[K],T,M,n.COLOR_ATTACHMENT0,n.TEXTURE_CUBE_MAP_POSITIVE_X+K,0);b(M)?v(n.TEXTURE_CUBE_MAP):M.mipmaps.length>0&&n.texParameteri(n.TEXTURE_CUBE_MAP,n.TEXTURE_MAX_LEVEL,M.mipmaps.length-1),e.unbindTexture()}else if(mt){for(let K=0,Q=nt.length;K<Q;K++){let ft=nt[K],P=i.get(ft),tt=n.TEXTURE_2D;(T.isWebGL3DRenderTarget||T.isWebGLArrayRenderTarget)&&(tt=T.isWebGL3DRenderTarget?n.TEXTURE_3D:n.TEXTURE_2D_ARRAY),e.bindTexture(tt,P.__webglTexture),Dt(tt,ft),me(G.__webglFramebuffer,T,ft,n.COLOR_ATTACHMENT0+K,tt,0),b(ft)&&v(tt)}e.unbindTexture()}else{let K=n.TEXTURE_2D;if((T.isWebGL3DRenderTarget||T.isWebGLArrayRenderTarget)&&(K=T.isWebGL3DRenderTarget?n.TEXTURE_3D:n.TEXTURE_2D_ARRAY),e.bindTexture(K,at.__webglTexture),Dt(K,M),M.mipmaps.length>0)for(let Q=0;Q<M.mipmaps.length;Q++)me(G.__webglFramebuffer[Q],T,M,n.COLOR_ATTACHMENT0,K,Q);else me(G.__webglFramebuffer,T,M,n.COLOR_ATTACHMENT0,K,0);b(M)?v(K):M.mipmaps.length>0&&n.texParameteri(K,n.TEXTURE_MAX_LEVEL,M.mipmaps.length-1),e.unbindTexture()}T.depthBuffer&&mn(T)}function F(T){let M=T.textures;for(let G=0,at=M.length;G<at;G++){let nt=M[G];if(b(nt)&&nt.mipmapsAutoUpdate===!0){let ht=A(T),mt=i.get(nt).__webglTexture;e.bindTexture(ht,mt),v(ht),e.unbindTexture()}}}let xn=[];function fe(T){if(T.samples>0){if(xt(T)===!1){let M=T.textures,G=T.width,at=T.height,nt=n.COLOR_BUFFER_BIT,ht=T.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,mt=i.get(T),K=M.length>1;if(K)for(let ft=0;ft<M.length;ft++)e.bindFramebuffer(n.FRAMEBUFFER,mt.__webglMultisampledFramebuffer),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+ft,n.RENDERBUFFER,null),e.bindFramebuffer(n.FRAMEBUFFER,mt.__webglFramebuffer),n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0+ft,n.TEXTURE_2D,null,0);e.bindFramebuffer(n.READ_FRAMEBUFFER,mt.__webglMultisampledFramebuffer),T.texture.mipmaps.length>0?e.bindFramebuffer(n.DRAW_FRAMEBUFFER,mt.__webglFramebuffer[0]):e.bindFramebuffer(n.DRAW_FRAMEBUFFER,mt.__webglFramebuffer);for(let ft=0;ft<M.length;ft++){if(T.resolveDepthBuffer&&(T.depthBuffer&&(nt|=n.DEPTH_BUFFER_BIT),T.stencilBuffer&&T.resolveStencilBuffer&&(nt|=n.STENCIL_BUFFER_BIT)),K){n.framebufferRenderbuffer(n.READ_FRAMEBUFFER,n.COLOR_ATTACHMENT0,n.RENDERBUFFER,mt.__webglColorRenderbuffer[ft]);let P=i.get(M[ft]).__webglTexture;n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0,n.TEXTURE_2D,P,0)}n.blitFramebuffer(0,0,G,at,0,0,G,at,nt,n.NEAREST),c===!0&&(xn.length=0,xn.push(n.COLOR_ATTACHMENT0+ft),T.depthBuffer&&T.storeMultisampledDepthBuffer===!1&&xn.push(ht),n.invalidateFramebuffer(n.READ_FRAMEBUFFER,xn))}if(e.bindFramebuffer(n.READ_FRAMEBUFFER,null),e.bindFramebuffer(n.DRAW_FRAMEBUFFER,null),K)for(let ft=0;ft<M.length;ft++){e.bindFramebuffer(n.FRAMEBUFFER,mt.__webglMultisampledFramebuffer),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+ft,n.RENDERBUFFER,mt.__webglColorRenderbuffer[ft]);let P=i.get(M[ft]).__webglTexture;e.bindFramebuffer(n.FRAMEBUFFER,mt.__webglFramebuffer),n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0+ft,n.TEXTURE_2D,P,0)}e.bindFramebuffer(n.DRAW_FRAMEBUFFER,mt.__webglMultisampledFramebuffer)}else if(T.depthBuffer&&T.storeMultisampledDepthBuffer===!1&&c){let M=T.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;n.invalidateFramebuffer(n.DRAW_FRAMEBUFFER,[M])}}}function de(T){return Math.min(s.maxSamples,T.samples)}function xt(T){let M=i.get(T);return T.samples>0&&t.has("WEBGL_multisampled_render_to_texture")===!0&&M.__useRenderToTexture!==!1}function be(T){let M=o.render.frame;h.get(T)!==M&&(h.set(T,M),T.update())}function Lt(T,M){let G=T.colorSpace,at=T.format,nt=T.type;return T.isCompressedTexture===!0||T.isVideoTexture===!0||G!==ho&&G!==Ai&&(Yt.getTransfer(G)===te?(at!==zn||nt!==an)&&It("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):Nt("WebGLTextures: Unsupported texture color space:",G)),M}function Ot(T){return typeof HTMLImageElement<"u"&&T instanceof HTMLImageElement?(l.width=T.naturalWidth||T.width,l.height=T.naturalHeight||T.height):typeof VideoFrame<"u"&&T instanceof VideoFrame?(l.width=T.displayWidth,l.height=T.displayHeight):(l.width=T.width,l.height=T.height),l}this.allocateTextureUnit=Z,this.resetTextureUnits=Y,this.getTextureUnits=st,this.setTextureUnits=O,this.setTexture2D=et,this.setTexture2DArray=it,this.setTexture3D=ot,this.setTextureCube=rt,this.rebindTextures=gn,this.setupRenderTarget=_n,this.updateRenderTargetMipmap=F,this.updateMultisampleRenderTarget=fe,this.setupDepthRenderbuffer=mn,this.setupFrameBufferTexture=me,this.useMultisampledRTT=xt,this.dispose=H}function B1(n,t){function e(i,s=Ai){let r,o=Yt.getTransfer(s);if(i===an)return n.UNSIGNED_BYTE;if(i===nc)return n.UNSIGNED_SHORT_4_4_4_4;if(i===ic)return n.UNSIGNED_SHORT_5_5_5_1;if(i===Qu)return n.UNSIGNED_INT_5_9_9_9_REV;if(i===tf)return n.UNSIGNED_INT_10F_11F_11F_REV;if(i===Ku)return n.BYTE;if(i===ju)return n.SHORT;if(i===Cr)return n.UNSIGNED_SHORT;if(i===ec)return n.INT;if(i===Fn)return n.UNSIGNED_INT;if(i===Bn)return n.FLOAT;if(i===kn)return n.HALF_FLOAT;if(i===ef)return n.ALPHA;if(i===nf)return n.RGB;if(i===zn)return n.RGBA;if(i===xi)return n.DEPTH_COMPONENT;if(i===Ei)return n.DEPTH_STENCIL;if(i===sf)return n.RED;if(i===sc)return n.RED_INTEGER;if(i===qi)return n.RG;if(i===rc)return n.RG_INTEGER;if(i===oc)return n.RGBA_INTEGER;if(i===Bo||i===ko||i===zo||i===Vo)if(o===te)if(r=t.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(i===Bo)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(i===ko)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(i===zo)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(i===Vo)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=t.get("WEBGL_compressed_texture_s3tc"),r!==null){if(i===Bo)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(i===ko)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(i===zo)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(i===Vo)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(i===ac||i===lc||i===cc||i===hc)if(r=t.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(i===ac)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(i===lc)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(i===cc)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(i===hc)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(i===uc||i===fc||i===dc||i===pc||i===mc||i===Go||i===gc)if(r=t.get("WEBGL_compressed_texture_etc"),r!==null){if(i===uc||i===fc)return o===te?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(i===dc)return o===te?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC;if(i===pc)return r.COMPRESSED_R11_EAC;if(i===mc)return r.COMPRESSED_SIGNED_R11_EAC;if(i===Go)return r.COMPRESSED_RG11_EAC;if(i===gc)return r.COMPRESSED_SIGNED_RG11_EAC}else return null;if(i===_c||i===xc||i===yc||i===vc||i===bc||i===Mc||i===Sc||i===wc||i===Ec||i===Ac||i===Tc||i===Cc||i===Rc||i===Pc)if(r=t.get("WEBGL_compressed_texture_astc"),r!==null){if(i===_c)return o===te?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(i===xc)return o===te?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(i===yc)return o===te?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(i===vc)return o===te?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(i===bc)return o===te?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(i===Mc)return o===te?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(i===Sc)return o===te?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(i===wc)return o===te?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(i===Ec)return o===te?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(i===Ac)return o===te?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(i===Tc)return o===te?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(i===Cc)return o===te?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(i===Rc)return o===te?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(i===Pc)return o===te?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(i===Ic||i===Lc||i===Nc)if(r=t.get("EXT_texture_compression_bptc"),r!==null){if(i===Ic)return o===te?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(i===Lc)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(i===Nc)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(i===Dc||i===Uc||i===Ho||i===Oc)if(r=t.get("EXT_texture_compression_rgtc"),r!==null){if(i===Dc)return r.COMPRESSED_RED_RGTC1_EXT;if(i===Uc)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(i===Ho)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(i===Oc)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return i===ws?n.UNSIGNED_INT_24_8:n[i]!==void 0?n[i]:null}return{convert:e}}var k1=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,z1=`
uniform sampler2DArray depthColor;
uniform float depthWidth;
uniform float depthHeight;

void main() {

	vec2 coord = vec2( gl_FragCoord.x / depthWidth, gl_FragCoord.y / depthHeight );

	if ( coord.x >= 1.0 ) {

		gl_FragDepth = texture( depthColor, vec3( coord.x - 1.0, coord.y, 1 ) ).r;

	} else {

		gl_FragDepth = texture( depthColor, vec3( coord.x, coord.y, 0 ) ).r;

	}

}`,Af=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(t,e){if(this.texture===null){let i=new bo(t.texture);(t.depthNear!==e.depthNear||t.depthFar!==e.depthFar)&&(this.depthNear=t.depthNear,this.depthFar=t.depthFar),this.texture=i}}getMesh(t){if(this.texture!==null&&this.mesh===null){let e=t.cameras[0].viewport,i=new Mn({vertexShader:k1,fragmentShader:z1,uniforms:{depthColor:{value:this.texture},depthWidth:{value:e.z},depthHeight:{value:e.w}}});this.mesh=new _e(new _s(20,20),i)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},Tf=class extends Nn{constructor(t,e){super();let i=this,s=null,r=1,o=null,a="local-floor",c=1,l=null,h=null,u=null,f=null,d=null,g=null,_=typeof XRWebGLBinding<"u",m=new Af,p={},y=e.getContextAttributes(),b=null,v=null,A=[],E=[],x=new Ct,w=null,D=null,R=new je;R.viewport=new ee;let L=new je;L.viewport=new ee;let I=[R,L],z=new Jl,C=null,H=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(B){let et=A[B];return et===void 0&&(et=new br,A[B]=et),et.getTargetRaySpace()},this.getControllerGrip=function(B){let et=A[B];return et===void 0&&(et=new br,A[B]=et),et.getGripSpace()},this.getHand=function(B){let et=A[B];return et===void 0&&(et=new br,A[B]=et),et.getHandSpace()};function q(B){let et=E.indexOf(B.inputSource);if(et===-1)return;let it=A[et];it!==void 0&&(it.update(B.inputSource,B.frame,l||o),it.dispatchEvent({type:B.type,data:B.inputSource}))}function V(){s.removeEventListener("select",q),s.removeEventListener("selectstart",q),s.removeEventListener("selectend",q),s.removeEventListener("squeeze",q),s.removeEventListener("squeezestart",q),s.removeEventListener("squeezeend",q),s.removeEventListener("end",V),s.removeEventListener("inputsourceschange",j);for(let B=0;B<A.length;B++){let et=E[B];et!==null&&(E[B]=null,A[B].disconnect(et))}C=null,H=null,m.reset();for(let B in p)delete p[B];if(t.setRenderTarget(b),d=null,f=null,u=null,s=null,v=null,Z.stop(),i.isPresenting=!1,t.setPixelRatio(w),t.setSize(x.width,x.height,!1),D!==null){let B=D.camera;B.fov=D.fov,B.zoom=D.zoom,B.updateProjectionMatrix(),D=null}i.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(B){r=B,i.isPresenting===!0&&It("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(B){a=B,i.isPresenting===!0&&It("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return l||o},this.setReferenceSpace=function(B){l=B},this.getBaseLayer=function(){return f!==null?f:d},this.getBinding=function(){return u===null&&_&&(u=new XRWebGLBinding(s,e)),u},this.getFrame=function(){return g},this.getSession=function(){return s},this.setSession=async function(B){if(s=B,s!==null){if(b=t.getRenderTarget(),s.addEventListener("select",q),s.addEventListener("selectstart",q),s.addEventListener("selectend",q),s.addEventListener("squeeze",q),s.addEventListener("squeezestart",q),s.addEventListener("squeezeend",q),s.addEventListener("end",V),s.addEventListener("inputsourceschange",j),y.xrCompatible!==!0&&await e.makeXRCompatible(),w=t.getPixelRatio(),t.getSize(x),_&&"createProjectionLayer"in XRWebGLBinding.prototype){let it=null,ot=null,rt=null;y.depth&&(rt=y.stencil?e.DEPTH24_STENCIL8:e.DEPTH_COMPONENT24,it=y.stencil?Ei:xi,ot=y.stencil?ws:Fn);let Mt={colorFormat:e.RGBA8,depthFormat:rt,scaleFactor:r};u=this.getBinding(),f=u.createProjectionLayer(Mt),s.updateRenderState({layers:[f]}),t.setPixelRatio(1),t.setSize(f.textureWidth,f.textureHeight,!1),v=new fn(f.textureWidth,f.textureHeight,{format:zn,type:an,depthTexture:new Mi(f.textureWidth,f.textureHeight,ot,void 0,void 0,void 0,void 0,void 0,void 0,it),stencilBuffer:y.stencil,colorSpace:t.outputColorSpace,samples:y.antialias?4:0,resolveDepthBuffer:f.ignoreDepthValues===!1,resolveStencilBuffer:f.ignoreDepthValues===!1,storeMultisampledDepthBuffer:f.ignoreDepthValues===!1,storeMultisampledStencilBuffer:f.ignoreDepthValues===!1})}else{let it={antialias:y.antialias,alpha:!0,depth:y.depth,stencil:y.stencil,framebufferScaleFactor:r};d=new XRWebGLLayer(s,e,it),s.updateRenderState({baseLayer:d}),t.setPixelRatio(1),t.setSize(d.framebufferWidth,d.framebufferHeight,!1),v=new fn(d.framebufferWidth,d.framebufferHeight,{format:zn,type:an,colorSpace:t.outputColorSpace,stencilBuffer:y.stencil,resolveDepthBuffer:d.ignoreDepthValues===!1,resolveStencilBuffer:d.ignoreDepthValues===!1,storeMultisampledDepthBuffer:d.ignoreDepthValues===!1,storeMultisampledStencilBuffer:d.ignoreDepthValues===!1})}v.isXRRenderTarget=!0,this.setFoveation(c),l=null,o=await s.requestReferenceSpace(a),Z.setContext(s),Z.start(),i.isPresenting=!0,i.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return m.getDepthTexture()};function j(B){for(let et=0;et<B.removed.length;et++){let it=B.removed[et],ot=E.indexOf(it);ot>=0&&(E[ot]=null,A[ot].disconnect(it))}for(let et=0;et<B.added.length;et++){let it=B.added[et],ot=E.indexOf(it);if(ot===-1){for(let Mt=0;Mt<A.length;Mt++)if(Mt>=E.length){E.push(it),ot=Mt;break}else if(E[Mt]===null){E[Mt]=it,ot=Mt;break}if(ot===-1)break}let rt=A[ot];rt&&rt.connect(it)}}function X(B,et){et===null?B.matrixWorld.copy(B.matrix):B.matrixWorld.multiplyMatrices(et.matrixWorld,B.matrix),B.matrixWorldInverse.copy(B.matrixWorld).invert()}this.updateCamera=function(B){if(s===null)return;let et=B.near,it=B.far;m.texture!==null&&(m.depthNear>0&&(et=m.depthNear),m.depthFar>0&&(it=m.depthFar)),z.near=L.near=R.near=et,z.far=L.far=R.far=it,(C!==z.near||H!==z.far)&&(s.updateRenderState({depthNear:z.near,depthFar:z.far}),C=z.near,H=z.far),z.layers.mask=B.layers.mask|6,R.layers.mask=z.layers.mask&-5,L.layers.mask=z.layers.mask&-3;let ot=B.parent,rt=z.cameras;X(z,ot);for(let Mt=0;Mt<rt.length;Mt++)X(rt[Mt],ot);z.projectionMatrix.copy(R.projectionMatrix),z.projectionMatrixInverse.copy(R.projectionMatrixInverse),D===null&&B.isPerspectiveCamera&&(D={camera:B,fov:B.fov,zoom:B.zoom}),Y(B,z,ot)};function Y(B,et,it){it===null?B.matrix.copy(et.matrixWorld):(B.matrix.copy(it.matrixWorld),B.matrix.invert(),B.matrix.multiply(et.matrixWorld)),B.matrix.decompose(B.position,B.quaternion,B.scale),B.updateMatrixWorld(!0),B.projectionMatrix.copy(et.projectionMatrix),B.projectionMatrixInverse.copy(et.projectionMatrixInverse),B.isPerspectiveCamera&&(B.fov=xr*2*Math.atan(1/B.projectionMatrix.elements[5]),B.zoom=1)}this.getCamera=function(){return z},this.getFoveation=function(){if(!(f===null&&d===null))return c},this.setFoveation=function(B){c=B,f!==null&&(f.fixedFoveation=B),d!==null&&d.fixedFoveation!==void 0&&(d.fixedFoveation=B)},this.hasDepthSensing=function(){return m.texture!==null},this.getDepthSensingMesh=function(){return m.getMesh(z)},this.getCameraTexture=function(B){return p[B]};let st=null;function O(B,et){if(h=et.getViewerPose(l||o),g=et,h!==null){let it=h.views;d!==null&&(t.setRenderTargetFramebuffer(v,d.framebuffer),t.setRenderTarget(v));let ot=!1;it.length!==z.cameras.length&&(z.cameras.length=0,ot=!0);for(let At=0;At<it.length;At++){let Dt=it[At],Xt=null;if(d!==null)Xt=d.getViewport(Dt);else{let ue=u.getViewSubImage(f,Dt);Xt=ue.viewport,At===0&&(t.setRenderTargetTextures(v,ue.colorTexture,ue.depthStencilTexture),t.setRenderTarget(v))}let Pt=I[At];Pt===void 0&&(Pt=new je,Pt.layers.enable(At),Pt.viewport=new ee,I[At]=Pt),Pt.matrix.fromArray(Dt.transform.matrix),Pt.matrix.decompose(Pt.position,Pt.quaternion,Pt.scale),Pt.projectionMatrix.fromArray(Dt.projectionMatrix),Pt.projectionMatrixInverse.copy(Pt.projectionMatrix).invert(),Pt.viewport.set(Xt.x,Xt.y,Xt.width,Xt.height),At===0&&(z.matrix.copy(Pt.matrix),z.matrix.decompose(z.position,z.quaternion,z.scale)),ot===!0&&z.cameras.push(Pt)}let rt=s.enabledFeatures;if(rt&&rt.includes("depth-sensing")&&s.depthUsage=="gpu-optimized"&&_){u=i.getBinding();let At=u.getDepthInformation(it[0]);At&&At.isValid&&At.texture&&m.init(At,s.renderState)}if(rt&&rt.includes("camera-access")&&_){t.state.unbindTexture(),u=i.getBinding();for(let At=0;At<it.length;At++){let Dt=it[At].camera;if(Dt){let Xt=p[Dt];Xt||(Xt=new bo,p[Dt]=Xt);let Pt=u.getCameraImage(Dt);Xt.sourceTexture=Pt}}}}for(let it=0;it<A.length;it++){let ot=E[it],rt=A[it];ot!==null&&rt!==void 0&&rt.update(ot,et,l||o)}st&&st(B,et),et.detectedPlanes&&i.dispatchEvent({type:"planesdetected",data:et}),g=null}let Z=new a0;Z.setAnimationLoop(O),this.setAnimationLoop=function(B){st=B},this.dispose=function(){}}},V1=new se,_0=new Ut;_0.set(-1,0,0,0,1,0,0,0,1);function G1(n,t){function e(m,p){m.matrixAutoUpdate===!0&&m.updateMatrix(),p.value.copy(m.matrix)}function i(m,p){p.color.getRGB(m.fogColor.value,pf(n)),p.isFog?(m.fogNear.value=p.near,m.fogFar.value=p.far):p.isFogExp2&&(m.fogDensity.value=p.density)}function s(m,p,y,b,v){p.isNodeMaterial?p.uniformsNeedUpdate=!1:p.isMeshBasicMaterial?r(m,p):p.isMeshLambertMaterial?(r(m,p),p.envMap&&(m.envMapIntensity.value=p.envMapIntensity)):p.isMeshToonMaterial?(r(m,p),u(m,p)):p.isMeshPhongMaterial?(r(m,p),h(m,p),p.envMap&&(m.envMapIntensity.value=p.envMapIntensity)):p.isMeshStandardMaterial?(r(m,p),f(m,p),p.isMeshPhysicalMaterial&&d(m,p,v)):p.isMeshMatcapMaterial?(r(m,p),g(m,p)):p.isMeshDepthMaterial?r(m,p):p.isMeshDistanceMaterial?(r(m,p),_(m,p)):p.isMeshNormalMaterial?r(m,p):p.isLineBasicMaterial?(o(m,p),p.isLineDashedMaterial&&a(m,p)):p.isPointsMaterial?c(m,p,y,b):p.isSpriteMaterial?l(m,p):p.isShadowMaterial?(m.color.value.copy(p.color),m.opacity.value=p.opacity):p.isShaderMaterial&&(p.uniformsNeedUpdate=!1)}function r(m,p){m.opacity.value=p.opacity,p.color&&m.diffuse.value.copy(p.color),p.emissive&&m.emissive.value.copy(p.emissive).multiplyScalar(p.emissiveIntensity),p.map&&(m.map.value=p.map,e(p.map,m.mapTransform)),p.alphaMap&&(m.alphaMap.value=p.alphaMap,e(p.alphaMap,m.alphaMapTransform)),p.bumpMap&&(m.bumpMap.value=p.bumpMap,e(p.bumpMap,m.bumpMapTransform),m.bumpScale.value=p.bumpScale,p.side===De&&(m.bumpScale.value*=-1)),p.normalMap&&(m.normalMap.value=p.normalMap,e(p.normalMap,m.normalMapTransform),m.normalScale.value.copy(p.normalScale),p.side===De&&m.normalScale.value.negate()),p.displacementMap&&(m.displacementMap.value=p.displacementMap,e(p.displacementMap,m.displacementMapTransform),m.displacementScale.value=p.displacementScale,m.displacementBias.value=p.displacementBias),p.emissiveMap&&(m.emissiveMap.value=p.emissiveMap,e(p.emissiveMap,m.emissiveMapTransform)),p.specularMap&&(m.specularMap.value=p.specularMap,e(p.specularMap,m.specularMapTransform)),p.alphaTest>0&&(m.alphaTest.value=p.alphaTest);let y=t.get(p),b=y.envMap,v=y.envMapRotation;b&&(m.envMap.value=b,m.envMapRotation.value.setFromMatrix4(V1.makeRotationFromEuler(v)).transpose(),b.isCubeTexture&&b.isRenderTargetTexture===!1&&m.envMapRotation.value.premultiply(_0),m.reflectivity.value=p.reflectivity,m.ior.value=p.ior,m.refractionRatio.value=p.refractionRatio),p.lightMap&&(m.lightMap.value=p.lightMap,m.lightMapIntensity.value=p.lightMapIntensity,e(p.lightMap,m.lightMapTransform)),p.aoMap&&(m.aoMap.value=p.aoMap,m.aoMapIntensity.value=p.aoMapIntensity,e(p.aoMap,m.aoMapTransform))}function o(m,p){m.diffuse.value.copy(p.color),m.opacity.value=p.opacity,p.map&&(m.map.value=p.map,e(p.map,m.mapTransform))}function a(m,p){m.dashSize.value=p.dashSize,m.totalSize.value=p.dashSize+p.gapSize,m.scale.value=p.scale}function c(m,p,y,b){m.diffuse.value.copy(p.color),m.opacity.value=p.opacity,m.size.value=p.size*y,m.scale.value=b*.5,p.map&&(m.map.value=p.map,e(p.map,m.uvTransform)),p.alphaMap&&(m.alphaMap.value=p.alphaMap,e(p.alphaMap,m.alphaMapTransform)),p.alphaTest>0&&(m.alphaTest.value=p.alphaTest)}function l(m,p){m.diffuse.value.copy(p.color),m.opacity.value=p.opacity,m.rotation.value=p.rotation,p.map&&(m.map.value=p.map,e(p.map,m.mapTransform)),p.alphaMap&&(m.alphaMap.value=p.alphaMap,e(p.alphaMap,m.alphaMapTransform)),p.alphaTest>0&&(m.alphaTest.value=p.alphaTest)}function h(m,p){m.specular.value.copy(p.specular),m.shininess.value=Math.max(p.shininess,1e-4)}function u(m,p){p.gradientMap&&(m.gradientMap.value=p.gradientMap)}function f(m,p){m.metalness.value=p.metalness,p.metalnessMap&&(m.metalnessMap.value=p.metalnessMap,e(p.metalnessMap,m.metalnessMapTransform)),m.roughness.value=p.roughness,p.roughnessMap&&(m.roughnessMap.value=p.roughnessMap,e(p.roughnessMap,m.roughnessMapTransform)),p.envMap&&(m.envMapIntensity.value=p.envMapIntensity)}function d(m,p,y){m.ior.value=p.ior,p.diffuseRoughness>0&&(m.diffuseRoughness.value=p.diffuseRoughness,p.diffuseRoughnessMap&&(m.diffuseRoughnessMap.value=p.diffuseRoughnessMap,e(p.diffuseRoughnessMap,m.diffuseRoughnessMapTransform))),p.sheen>0&&(m.sheenColor.value.copy(p.sheenColor).multiplyScalar(p.sheen),m.sheenRoughness.value=p.sheenRoughness,p.sheenColorMap&&(m.sheenColorMap.value=p.sheenColorMap,e(p.sheenColorMap,m.sheenColorMapTransform)),p.sheenRoughnessMap&&(m.sheenRoughnessMap.value=p.sheenRoughnessMap,e(p.sheenRoughnessMap,m.sheenRoughnessMapTransform))),p.clearcoat>0&&(m.clearcoat.value=p.clearcoat,m.clearcoatRoughness.value=p.clearcoatRoughness,p.clearcoatMap&&(m.clearcoatMap.value=p.clearcoatMap,e(p.clearcoatMap,m.clearcoatMapTransform)),p.clearcoatRoughnessMap&&(m.clearcoatRoughnessMap.value=p.clearcoatRoughnessMap,e(p.clearcoatRoughnessMap,m.clearcoatRoughnessMapTransform)),p.clearcoatNormalMap&&(m.clearcoatNormalMap.value=p.clearcoatNormalMap,e(p.clearcoatNormalMap,m.clearcoatNormalMapTransform),m.clearcoatNormalScale.value.copy(p.clearcoatNormalScale),p.side===De&&m.clearcoatNormalScale.value.negate())),p.dispersion>0&&(m.dispersion.value=p.dispersion),p.retroreflectivity>0&&(m.retroreflectivity.value=p.retroreflectivity),p.iridescence>0&&(m.iridescence.value=p.iridescence,m.iridescenceIOR.value=p.iridescenceIOR,m.iridescenceThicknessMinimum.value=p.iridescenceThicknessMinimum,m.iridescenceThicknessMaximum.value=p.iridescenceThicknessMaximum,p.iridescenceMap&&(m.iridescenceMap.value=p.iridescenceMap,e(p.iridescenceMap,m.iridescenceMapTransform)),p.iridescenceThicknessMap&&(m.iridescenceThicknessMap.value=p.iridescenceThicknessMap,e(p.iridescenceThicknessMap,m.iridescenceThicknessMapTransform))),p.transmission>0&&(m.transmission.value=p.transmission,m.transmissionSamplerMap.value=y.texture,m.transmissionSamplerSize.value.set(y.width,y.height),p.transmissionMap&&(m.transmissionMap.value=p.transmissionMap,e(p.transmissionMap,m.transmissionMapTransform)),m.thickness.value=p.thickness,p.thicknessMap&&(m.thicknessMap.value=p.thicknessMap,e(p.thicknessMap,m.thicknessMapTransform)),m.attenuationDistance.value=p.attenuationDistance,m.attenuationColor.value.copy(p.attenuationColor)),p.anisotropy>0&&(m.anisotropyVector.value.set(p.anisotropy*Math.cos(p.anisotropyRotation),p.anisotropy*Math.sin(p.anisotropyRotation)),p.anisotropyMap&&(m.anisotropyMap.value=p.anisotropyMap,e(p.anisotropyMap,m.anisotropyMapTransform))),m.specularIntensity.value=p.specularIntensity,m.specularColor.value.copy(p.specularColor),p.specularColorMap&&(m.specularColorMap.value=p.specularColorMap,e(p.specularColorMap,m.specularColorMapTransform)),p.specularIntensityMap&&(m.specularIntensityMap.value=p.specularIntensityMap,e(p.specularIntensityMap,m.specularIntensityMapTransform))}function g(m,p){p.matcap&&(m.matcap.value=p.matcap)}function _(m,p){let y=t.get(p).light;m.referencePosition.value.setFromMatrixPosition(y.matrixWorld),m.nearDistance.value=y.shadow.camera.near,m.farDistance.value=y.shadow.camera.far}return{refreshFogUniforms:i,refreshMaterialUniforms:s}}function H1(n,t,e,i){let s={},r={};function o(y,b){let v=b.program;i.uniformBlockBinding(y,v,s[y.id])}function a(y,b){let v=s[y.id];v===void 0&&(g(y),v=c(y),s[y.id]=v,y.addEventListener("dispose",m));let A=b.program;i.updateUBOMapping(y,A);let E=t.render.frame;r[y.id]!==E&&(l(y),r[y.id]=E)}function c(y){let b=n.createBuffer(),v=y.__size,A=y.usage;return n.bindBuffer(n.UNIFORM_BUFFER,b),n.bufferData(n.UNIFORM_BUFFER,v,A),n.bindBuffer(n.UNIFORM_BUFFER,null),b}function l(y){let b=s[y.id],v=y.uniforms,A=y.__cache;n.bindBuffer(n.UNIFORM_BUFFER,b);for(let E=0,x=v.length;E<x;E++){let w=v[E];if(Array.isArray(w))for(let D=0,R=w.length;D<R;D++)h(w[D],E,D,A);else h(w,E,0,A)}n.bindBuffer(n.UNIFORM_BUFFER,null)}function h(y,b,v,A){if(f(y,b,v,A)===!0){let E=y.__offset,x=y.value;if(Array.isArray(x)){let w=0;for(let D=0;D<x.length;D++){let R=x[D],L=_(R,!0);u(R,y.__data,w),w+=L.storage/Float32Array.BYTES_PER_ELEMENT}}else u(x,y.__data,0);n.bufferSubData(n.UNIFORM_BUFFER,E,y.__data)}}function u(y,b,v){typeof y=="number"||typeof y=="boolean"?b[v]=y:y.isMatrix3?(b[v]=y.elements[0],b[v+1]=y.elements[1],b[v+2]=y.elements[2],b[v+3]=0,b[v+4]=y.elements[3],b[v+5]=y.elements[4],b[v+6]=y.elements[5],b[v+7]=0,b[v+8]=y.elements[6],b[v+9]=y.elements[7],b[v+10]=y.elements[8],b[v+11]=0):ArrayBuffer.isView(y)?b.set(y.subarray(0,b.length-v),v):y.toArray(b,v)}function f(y,b,v,A){let E=y.value,x=b+"_"+v;if(Array.isArray(E)){A[x]===void 0&&(A[x]=[]);let w=A[x],D=!1;for(let R=0;R<E.length;R++)d(E[R],w,R)===!0&&(D=!0);return D}return d(E,A,x)}function d(y,b,v){if(b[v]===void 0)return typeof y=="number"||typeof y=="boolean"?b[v]=y:ArrayBuffer.isView(y)?b[v]=y.slice():b[v]=y.clone(),!0;{let A=b[v];if(typeof y=="number"||typeof y=="boolean"){if(A!==y)return b[v]=y,!0}else{if(ArrayBuffer.isView(y))return!0;if(A.equals(y)===!1)return A.copy(y),!0}}return!1}function g(y){let b=y.uniforms,v=0,A=16;for(let x=0,w=b.length;x<w;x++){let D=Array.isArray(b[x])?b[x]:[b[x]];for(let R=0,L=D.length;R<L;R++){let I=D[R],z=Array.isArray(I.value)?I.value:[I.value],C=Array.isArray(b[x])||Array.isArray(I.value),H=v;for(let V=0,j=z.length;V<j;V++){let X=z[V],Y=_(X,C),st=v%A,O=st%Y.boundary,Z=st+O;v+=O,Z!==0&&A-Z<Y.storage&&(v+=A-Z),V===0&&(H=v),v+=Y.storage}let q=I.type==="int"?Int32Array:I.type==="uint"?Uint32Array:Float32Array;I.__data=new q((v-H)/Float32Array.BYTES_PER_ELEMENT),I.__offset=H}}let E=v%A;return E>0&&(v+=A-E),y.__size=v,y.__cache={},this}function _(y,b){let v={boundary:0,storage:0};return typeof y=="number"||typeof y=="boolean"?(v.boundary=4,v.storage=4):y.isVector2?(v.boundary=8,v.storage=8):y.isVector3||y.isColor?(v.boundary=16,v.storage=12):y.isVector4?(v.boundary=16,v.storage=16):y.isMatrix3?(v.boundary=16,v.storage=48):y.isMatrix4?(v.boundary=16,v.storage=64):y.isTexture?It("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(y)?(v.boundary=16,v.storage=y.byteLength):It("WebGLRenderer: Unsupported uniform value type.",y),b===!0&&(v.boundary=16,v.storage=Math.ceil(v.storage/16)*16),v}function m(y){let b=y.target;b.removeEventListener("dispose",m),n.deleteBuffer(s[b.id]),delete s[b.id],delete r[b.id]}function p(){for(let y in s)n.deleteBuffer(s[y]);s={},r={}}return{bind:o,update:a,dispose:p}}var W1=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),Jn=null;function X1(){return Jn===null&&(Jn=new Il(W1,16,16,qi,kn),Jn.name="DFG_LUT",Jn.minFilter=Qe,Jn.magFilter=Qe,Jn.wrapS=qn,Jn.wrapT=qn,Jn.generateMipmaps=!1,Jn.needsUpdate=!0),Jn}var Gc=class{constructor(t={}){let{canvas:e=Ng(),context:i=null,depth:s=!0,stencil:r=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:c=!0,preserveDrawingBuffer:l=!1,powerPreference:h="default",failIfMajorPerformanceCaveat:u=!1,reversedDepthBuffer:f=!1,outputBufferType:d=an}=t;this.isWebGLRenderer=!0;let g;if(i!==null){if(typeof WebGLRenderingContext<"u"&&i instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");g=i.getContextAttributes().alpha}else g=o;let _=d,m=new Set([oc,rc,sc]),p=new Set([an,Fn,Cr,ws,nc,ic]),y=new Uint32Array(4),b=new Int32Array(4),v={textures:[],min:[],max:[],resolution:[]},A=null,E=null,x=[],w=[],D=null;this.domElement=e,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=Zn,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let R=this,L=!1,I=null,z=null,C=null,H=null;this._outputColorSpace=Je;let q=0,V=0,j=null,X=-1,Y=null,st=new ee,O=new ee,Z=null,B=new zt(0),et=0,it=e.width,ot=e.height,rt=1,Mt=null,Wt=null,At=new ee(0,0,it,ot),Dt=new ee(0,0,it,ot),Xt=!1,Pt=new Bi,ue=new Ll,ae=!1,ve=!1,me=new se,Vn=new N,Ee=new ee,mn={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},gn=!1;function _n(){return j===null?rt:1}let F=i;function xn(S,U){return e.getContext(S,U)}let fe,de,xt,be,Lt,Ot,T,M,G,at,nt,ht,mt,K,Q,ft,P,tt,J,dt,ct,ut,Tt;try{let S={alpha:!0,depth:s,stencil:r,antialias:a,premultipliedAlpha:c,preserveDrawingBuffer:l,powerPreference:h,failIfMajorPerformanceCaveat:u};if("setAttribute"in e&&e.setAttribute("data-engine",`three.js r${"187"}`),e.addEventListener("webglcontextlost",Rt,!1),e.addEventListener("webglcontextrestored",kt,!1),e.addEventListener("webglcontextcreationerror",yt,!1),F===null){let U="webgl2";if(F=xn(U,S),F===null)throw xn(U)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}Vt()}catch(S){throw e.removeEventListener("webglcontextlost",Rt,!1),e.removeEventListener("webglcontextrestored",kt,!1),e.removeEventListener("webglcontextcreationerror",yt,!1),Nt("WebGLRenderer: "+S.message),S}function Vt(){fe=new nw(F),fe.init(),ct=new B1(F,fe),de=new XS(F,fe,t,ct),xt=new O1(F,fe),de.reversedDepthBuffer&&f&&xt.buffers.depth.setReversed(!0),z=F.createFramebuffer(),C=F.createFramebuffer(),H=F.createFramebuffer(),be=new rw(F),Lt=new M1,Ot=new F1(F,fe,xt,Lt,de,ct,be),T=new ew(R),M=new ab(F),ut=new HS(F,M),G=new iw(F,M,be,ut),at=new aw(F,G,M,ut,be),tt=new ow(F,de,Ot),Q=new $S(Lt),nt=new b1(R,T,fe,de,ut,Q),ht=new G1(R,Lt),mt=new w1,K=new P1(fe),P=new GS(R,T,xt,at,g,c),ft=new U1(R,at,de),Tt=new H1(F,be,de,xt),J=new WS(F,fe,be),dt=new sw(F,fe,be),be.programs=nt.programs,R.capabilities=de,R.extensions=fe,R.properties=Lt,R.renderLists=mt,R.shadowMap=ft,R.state=xt,R.info=be}_!==an&&(D=new cw(_,e.width,e.height,a,s,r));let lt=new Tf(R,F);this.xr=lt,this.getContext=function(){return F},this.getContextAttributes=function(){return F.getContextAttributes()},this.forceContextLoss=function(){let S=fe.get("WEBGL_lose_context");S&&S.loseContext()},this.forceContextRestore=function(){let S=fe.get("WEBGL_lose_context");S&&S.restoreContext()},this.getPixelRatio=function(){return rt},this.setPixelRatio=function(S){S!==void 0&&(rt=S,this.setSize(it,ot,!1))},this.getSize=function(S){return S.set(it,ot)},this.setSize=function(S,U,$=!0){if(lt.isPresenting){It("WebGLRenderer: Can't change size while VR device is presenting.");return}it=S,ot=U,e.width=Math.floor(S*rt),e.height=Math.floor(U*rt),$===!0&&(e.style.width=S+"px",e.style.height=U+"px"),D!==null&&D.setSize(e.width,e.height),this.setViewport(0,0,S,U)},this.getDrawingBufferSize=function(S){return S.set(it*rt,ot*rt).floor()},this.setDrawingBufferSize=function(S,U,$){it=S,ot=U,rt=$,e.width=Math.floor(S*$),e.height=Math.floor(U*$),this.setViewport(0,0,S,U)},this.setEffects=function(S){if(_===an){Nt("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(S){for(let U=0;U<S.length;U++)if(S[U].isOutputPass===!0){It("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}D.setEffects(S||[])},this.getCurrentViewport=function(S){return S.copy(st)},this.getViewport=function(S){return S.copy(At)},this.setViewport=function(S,U,$,k){S.isVector4?At.set(S.x,S.y,S.z,S.w):At.set(S,U,$,k),xt.viewport(st.copy(At).multiplyScalar(_n()).round())},this.getScissor=function(S){return S.copy(Dt)},this.setScissor=function(S,U,$,k){S.isVector4?Dt.set(S.x,S.y,S.z,S.w):Dt.set(S,U,$,k),xt.scissor(O.copy(Dt).multiplyScalar(_n()).round())},this.getScissorTest=function(){return Xt},this.setScissorTest=function(S){xt.setScissorTest(Xt=S)},this.setOpaqueSort=function(S){Mt=S},this.setTransparentSort=function(S){Wt=S},this.getClearColor=function(S){return S.copy(P.getClearColor())},this.setClearColor=function(){P.setClearColor(...arguments)},this.getClearAlpha=function(){return P.getClearAlpha()},this.setClearAlpha=function(){P.setClearAlpha(...arguments)},this.clear=function(S=!0,U=!0,$=!0){let k=0;if(S){let W=!1;if(j!==null){let gt=j.texture.format;W=m.has(gt)}if(W){let gt=j.texture.type,bt=p.has(gt),pt=P.getClearColor(),vt=P.getClearAlpha(),Et=pt.r,Ft=pt.g,$t=pt.b;bt?(y[0]=Et,y[1]=Ft,y[2]=$t,y[3]=vt,F.clearBufferuiv(F.COLOR,0,y)):(b[0]=Et,b[1]=Ft,b[2]=$t,b[3]=vt,F.clearBufferiv(F.COLOR,0,b))}else k|=F.COLOR_BUFFER_BIT}U&&(k|=F.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),$&&(k|=F.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),k!==0&&F.clear(k)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(S){S.setRenderer(this),I=S},this.dispose=function(){e.removeEventListener("webglcontextlost",Rt,!1),e.removeEventListener("webglcontextrestored",kt,!1),e.removeEventListener("webglcontextcreationerror",yt,!1),P.dispose(),mt.dispose(),K.dispose(),Ot.dispose(),Lt.dispose(),T.dispose(),at.dispose(),G.dispose(),ut.dispose(),Tt.dispose(),nt.dispose(),lt.dispose(),lt.removeEventListener("sessionstart",Bf),lt.removeEventListener("sessionend",kf),Ji.stop()};function Rt(S){S.preventDefault(),po("WebGLRenderer: Context Lost."),L=!0}function kt(){po("WebGLRenderer: Context Restored."),L=!1;let S=be.autoReset,U=ft.enabled,$=ft.autoUpdate,k=ft.needsUpdate,W=ft.type;Vt(),be.autoReset=S,ft.enabled=U,ft.autoUpdate=$,ft.needsUpdate=k,ft.type=W}function yt(S){Nt("WebGLRenderer: A WebGL context could not be created. Reason: ",S.statusMessage)}function ne(S){let U=S.target;U.removeEventListener("dispose",ne),Ae(U)}function Ae(S){Ti(S),Lt.remove(S)}function Ti(S){let U=Lt.get(S).programs;U!==void 0&&(U.forEach(function($){nt.releaseProgram($)}),S.isShaderMaterial&&nt.releaseShaderCache(S))}this.renderBufferDirect=function(S,U,$,k,W,gt){U===null&&(U=mn);let bt=W.isMesh&&W.matrixWorld.determinantAffine()<0,pt=$0(S,U,$,k,W);xt.setMaterial(k,bt);let vt=$.index,Et=1;if(k.wireframe===!0){if(vt=G.getWireframeAttribute($),vt===void 0)return;Et=2}let Ft=$.drawRange,$t=$.attributes.position,St=Ft.start*Et,qt=(Ft.start+Ft.count)*Et;gt!==null&&(St=Math.max(St,gt.start*Et),qt=Math.min(qt,(gt.start+gt.count)*Et)),vt!==null?(St=Math.max(St,0),qt=Math.min(qt,vt.count)):$t!=null&&(St=Math.max(St,0),qt=Math.min(qt,$t.count));let xe=qt-St;if(xe<0||xe===1/0)return;ut.setup(W,k,pt,$,vt);let le,re=J;if(vt!==null&&(le=M.get(vt),re=dt,re.setIndex(le)),W.isMesh)k.wireframe===!0?(xt.setLineWidth(k.wireframeLinewidth*_n()),re.setMode(F.LINES)):re.setMode(F.TRIANGLES);else if(W.isLine){let Be=k.linewidth;Be===void 0&&(Be=1),xt.setLineWidth(Be*_n()),W.isLineSegments?re.setMode(F.LINES):W.isLineLoop?re.setMode(F.LINE_LOOP):re.setMode(F.LINE_STRIP)}else W.isPoints?re.setMode(F.POINTS):W.isSprite&&re.setMode(F.TRIANGLES);if(W.isBatchedMesh)if(fe.get("WEBGL_multi_draw"))re.renderMultiDraw(W._multiDrawStarts,W._multiDrawCounts,W._multiDrawCount);else{let Be=W._multiDrawStarts,wt=W._multiDrawCounts,Ye=W._multiDrawCount,jt=vt?M.get(vt).bytesPerElement:1,Ki=Lt.get(k).currentProgram.getUniforms();for(let ke=0;ke<Ye;ke++)Ki.setValue(F,"_gl_DrawID",ke),re.render(Be[ke]/jt,wt[ke])}else if(W.isInstancedMesh)re.renderInstances(St,xe,W.count);else if($.isInstancedBufferGeometry){let Be=$._maxInstanceCount!==void 0?$._maxInstanceCount:1/0,wt=Math.min($.instanceCount,Be);re.renderInstances(St,xe,wt)}else re.render(St,xe)};function Ff(S,U,$,k){I!==null&&S.isNodeMaterial&&I.setObject(k,S),ae===!0&&Q.setState(S,$,!1),S.transparent===!0&&S.side===Sn&&S.forceSinglePass===!1?(S.side=De,S.needsUpdate=!0,Or(S,U,k),S.side=$i,S.needsUpdate=!0,Or(S,U,k),S.side=Sn):Or(S,U,k)}this.compile=function(S,U,$=null){$===null&&($=S),I!==null&&I.renderStart(S,U,$),E=K.get($),E.init(U),w.push(E),$.traverseVisible(function(W){W.isLight&&W.layers.test(U.layers)&&(E.pushLight(W),W.castShadow&&E.pushShadow(W))}),S!==$&&S.traverseVisible(function(W){W.isLight&&W.layers.test(U.layers)&&(E.pushLight(W),W.castShadow&&E.pushShadow(W))}),E.setupLights(),I!==null&&I.updateLights(E.state.lightsArray),ve=this.localClippingEnabled,ae=Q.init(this.clippingPlanes,ve),ae===!0&&Q.setGlobalState(this.clippingPlanes,U),I!==null&&ft.render(E.state.shadowsArray,$,U);let k=new Set;return S.traverse(function(W){if(!(W.isMesh||W.isPoints||W.isLine||W.isSprite))return;let gt=W.material;if(gt)if(Array.isArray(gt))for(let bt=0;bt<gt.length;bt++){let pt=gt[bt];Ff(pt,$,U,W),k.add(pt)}else Ff(gt,$,U,W),k.add(gt)}),E=w.pop(),I!==null&&I.renderEnd(),k},this.compileAsync=function(S,U,$=null){let k=this.compile(S,U,$);return new Promise(W=>{function gt(){if(k.forEach(function(bt){let vt=Lt.get(bt).currentProgram;(vt===void 0||vt.isReady())&&k.delete(bt)}),k.size===0){W(S);return}setTimeout(gt,10)}fe.get("KHR_parallel_shader_compile")!==null?gt():setTimeout(gt,10)})};let Qc=null;function W0(S){Qc&&Qc(S)}function Bf(){Ji.stop()}function kf(){Ji.start()}let Ji=new a0;Ji.setAnimationLoop(W0),typeof self<"u"&&Ji.setContext(self),this.setAnimationLoop=function(S){Qc=S,lt.setAnimationLoop(S),S===null?Ji.stop():Ji.start()},lt.addEventListener("sessionstart",Bf),lt.addEventListener("sessionend",kf),this.render=function(S,U){if(U!==void 0&&U.isCamera!==!0){Nt("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(L===!0)return;I!==null&&I.renderStart(S,U);let $=lt.enabled===!0&&lt.isPresenting===!0,k=D!==null&&(j===null||$)&&D.begin(R,j);if(S.matrixWorldAutoUpdate===!0&&S.updateMatrixWorld(),U.parent===null&&U.matrixWorldAutoUpdate===!0&&U.updateMatrixWorld(),lt.enabled===!0&&lt.isPresenting===!0&&(D===null||D.isCompositing()===!1)&&(lt.cameraAutoUpdate===!0&&lt.updateCamera(U),U=lt.getCamera()),S.isScene===!0&&S.onBeforeRender(R,S,U,j),E=K.get(S,w.length),E.init(U),E.state.textureUnits=Ot.getTextureUnits(),w.push(E),me.multiplyMatrices(U.projectionMatrix,U.matrixWorldInverse),U.isArrayCamera?ue.setFromArrayCamera(U):Pt.setFromProjectionMatrix(me,bn,U.reversedDepth),ve=this.localClippingEnabled,ae=Q.init(this.clippingPlanes,ve),A=mt.get(S,x.length),A.init(),x.push(A),this.info.render.frame++,lt.enabled===!0&&lt.isPresenting===!0){let bt=R.xr.getDepthSensingMesh();bt!==null&&th(bt,U,-1/0,R.sortObjects)}th(S,U,0,R.sortObjects),A.finish(),I!==null&&I.updateLights(E.state.lightsArray),R.sortObjects===!0&&A.sort(Mt,Wt),gn=lt.enabled===!1||lt.isPresenting===!1||lt.hasDepthSensing()===!1,gn&&P.addToRenderList(A,S),this.info.autoReset===!0&&this.info.reset(),ae===!0&&Q.beginShadows();let W=E.state.shadowsArray;if(ft.render(W,S,U),ae===!0&&Q.endShadows(),(k&&D.hasRenderPass())===!1){let bt=A.opaque,pt=A.transmissive;if(E.setupLights(),U.isArrayCamera){let vt=U.cameras;if(pt.length>0)for(let Et=0,Ft=vt.length;Et<Ft;Et++){let $t=vt[Et];Vf(bt,pt,S,$t)}gn&&P.render(S);for(let Et=0,Ft=vt.length;Et<Ft;Et++){let $t=vt[Et];zf(A,S,$t,$t.viewport)}}else pt.length>0&&Vf(bt,pt,S,U),gn&&P.render(S),zf(A,S,U)}j!==null&&V===0&&(Ot.updateMultisampleRenderTarget(j),Ot.updateRenderTargetMipmap(j)),k&&D.end(R),S.isScene===!0&&S.onAfterRender(R,S,U),ut.resetDefaultState(),X=-1,Y=null,w.pop(),w.length>0?(E=w[w.length-1],Ot.setTextureUnits(E.state.textureUnits),ae===!0&&Q.setGlobalState(R.clippingPlanes,E.state.camera)):E=null,x.pop(),x.length>0?A=x[x.length-1]:A=null,I!==null&&I.renderEnd()};function th(S,U,$,k){if(S.visible===!1)return;if(S.layers.test(U.layers)){if(S.isGroup)$=S.renderOrder;else if(S.isLOD)S.autoUpdate===!0&&S.update(U);else if(S.isLight)E.pushLight(S),S.castShadow&&E.pushShadow(S);else if(S.isSprite){let bt=U.isArrayCamera?ue:Pt;if(!S.frustumCulled||S.intersectsFrustum(bt)){k&&Ee.setFromMatrixPosition(S.matrixWorld).applyMatrix4(me);let pt=at.update(S),vt=S.material;vt.visible&&A.push(S,pt,vt,$,Ee.z,null,U)}}else if(S.isMesh||S.isLine||S.isPoints){let bt=U.isArrayCamera?ue:Pt;if(!S.frustumCulled||S.intersectsFrustum(bt)){let pt=at.update(S),vt=S.material;if(k&&(S.boundingSphere!==void 0?(S.boundingSphere===null&&S.computeBoundingSphere(),Ee.copy(S.boundingSphere.center)):(pt.boundingSphere===null&&pt.computeBoundingSphere(),Ee.copy(pt.boundingSphere.center)),Ee.applyMatrix4(S.matrixWorld).applyMatrix4(me)),Array.isArray(vt)){let Et=pt.groups;for(let Ft=0,$t=Et.length;Ft<$t;Ft++){let St=Et[Ft],qt=vt[St.materialIndex];qt&&qt.visible&&A.push(S,pt,qt,$,Ee.z,St,U)}}else vt.visible&&A.push(S,pt,vt,$,Ee.z,null,U)}}}let gt=S.children;for(let bt=0,pt=gt.length;bt<pt;bt++)th(gt[bt],U,$,k)}function zf(S,U,$,k){let{opaque:W,transmissive:gt,transparent:bt}=S;E.setupLightsView($),ae===!0&&Q.setGlobalState(R.clippingPlanes,$),k&&xt.viewport(st.copy(k)),W.length>0&&Qo(W,U,$),gt.length>0&&Qo(gt,U,$),bt.length>0&&Qo(bt,U,$),xt.buffers.depth.setTest(!0),xt.buffers.depth.setMask(!0),xt.buffers.color.setMask(!0),xt.setPolygonOffset(!1)}function Vf(S,U,$,k){if(($.isScene===!0?$.overrideMaterial:null)!==null)return;if(E.state.transmissionRenderTarget[k.id]===void 0){let St=fe.has("EXT_color_buffer_half_float")||fe.has("EXT_color_buffer_float");E.state.transmissionRenderTarget[k.id]=new fn(1,1,{generateMipmaps:!0,type:St?kn:an,minFilter:wi,samples:Math.max(4,de.samples),stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:Yt.workingColorSpace})}let gt=E.state.transmissionRenderTarget[k.id],bt=k.viewport||st;gt.setSize(bt.z*R.transmissionResolutionScale,bt.w*R.transmissionResolutionScale);let pt=R.getRenderTarget(),vt=R.getActiveCubeFace(),Et=R.getActiveMipmapLevel();R.setRenderTarget(gt),R.getClearColor(B),et=R.getClearAlpha(),et<1&&R.setClearColor(16777215,.5),R.clear(),gn&&P.render($);let Ft=R.toneMapping;R.toneMapping=Zn;let $t=k.viewport;if(k.viewport!==void 0&&(k.viewport=void 0),E.setupLightsView(k),ae===!0&&Q.setGlobalState(R.clippingPlanes,k),Qo(S,$,k),Ot.updateMultisampleRenderTarget(gt),Ot.updateRenderTargetMipmap(gt),fe.has("WEBGL_multisampled_render_to_texture")===!1){let St=!1;for(let qt=0,xe=U.length;qt<xe;qt++){let le=U[qt],{object:re,geometry:Be,material:wt,group:Ye}=le;if(wt.side===Sn&&re.layers.test(k.layers)){let jt=wt.side;wt.side=De,wt.needsUpdate=!0,Gf(re,$,k,Be,wt,Ye),wt.side=jt,wt.needsUpdate=!0,St=!0}}St===!0&&(Ot.updateMultisampleRenderTarget(gt),Ot.updateRenderTargetMipmap(gt))}R.setRenderTarget(pt,vt,Et),R.setClearColor(B,et),$t!==void 0&&(k.viewport=$t),R.toneMapping=Ft}function Qo(S,U,$){let k=U.isScene===!0?U.overrideMaterial:null;for(let W=0,gt=S.length;W<gt;W++){let bt=S[W],{object:pt,geometry:vt,group:Et}=bt,Ft=bt.material;Ft.allowOverride===!0&&k!==null&&(Ft=k),pt.layers.test($.layers)&&Gf(pt,U,$,vt,Ft,Et)}}function Gf(S,U,$,k,W,gt){I!==null&&W.isNodeMaterial&&I.setObject(S,W),S.onBeforeRender(R,U,$,k,W,gt),S.modelViewMatrix.multiplyMatrices($.matrixWorldInverse,S.matrixWorld),S.normalMatrix.getNormalMatrix(S.modelViewMatrix),W.onBeforeRender(R,U,$,k,S,gt),W.transparent===!0&&W.side===Sn&&W.forceSinglePass===!1?(W.side=De,W.needsUpdate=!0,R.renderBufferDirect($,U,k,W,S,gt),W.side=$i,W.needsUpdate=!0,R.renderBufferDirect($,U,k,W,S,gt),W.side=Sn):R.renderBufferDirect($,U,k,W,S,gt),S.onAfterRender(R,U,$,k,W,gt)}function Hf(S){let U=0;for(let $ of S)$.texture!==null&&U++;return U}function Or(S,U,$){U.isScene!==!0&&(U=mn);let k=Lt.get(S),W=E.state.lights,gt=E.state.shadowsArray,bt=W.state.version,pt=nt.getParameters(S,W.state,gt,U,$,E.state.lightProbeGridArray),vt=nt.getProgramCacheKey(pt),Et=k.programs;k.environment=S.isMeshStandardMaterial||S.isMeshLambertMaterial||S.isMeshPhongMaterial?U.environment:null,k.fog=U.fog;let Ft=S.isMeshStandardMaterial||S.isMeshLambertMaterial&&!S.envMap||S.isMeshPhongMaterial&&!S.envMap;k.envMap=T.get(S.envMap||k.environment,Ft),k.envMapRotation=k.environment!==null&&S.envMap===null?U.environmentRotation:S.envMapRotation,Et===void 0&&(S.addEventListener("dispose",ne),Et=new Map,k.programs=Et,k.programVariants=new Map);let $t=Et.get(vt);if($t!==void 0){if(k.currentProgram===$t&&k.lightsStateVersion===bt)return Xf(S,pt),$t}else pt.uniforms=nt.getUniforms(S),I!==null&&S.isNodeMaterial&&I.build(S,$,pt),S.onBeforeCompile(pt,R),$t=nt.acquireProgram(pt,vt),Et.set(vt,$t),k.uniforms=pt.uniforms;let St=k.uniforms;return(!S.isShaderMaterial&&!S.isRawShaderMaterial||S.clipping===!0)&&(St.clippingPlanes=Q.uniform),Xf(S,pt),k.needsLights=Y0(S),k.lightsStateVersion=bt,k.needsLights&&(St.ambientLightColor.value=W.state.ambient,St.lightProbe.value=W.state.probe,St.sunLights.value=W.state.sun,St.sunLightShadows.value=W.state.sunShadow,St.directionalLights.value=W.state.directional,St.directionalLightShadows.value=W.state.directionalShadow,St.spotLights.value=W.state.spot,St.spotLightShadows.value=W.state.spotShadow,St.rectAreaLights.value=W.state.rectArea,St.ltc_1.value=W.state.rectAreaLTC1,St.ltc_2.value=W.state.rectAreaLTC2,St.pointLights.value=W.state.point,St.pointLightShadows.value=W.state.pointShadow,St.hemisphereLights.value=W.state.hemi,St.sunShadowMatrix.value=W.state.sunShadowMatrix,St.sunShadowCascade.value=W.state.sunShadowCascade,St.directionalShadowMatrix.value=W.state.directionalShadowMatrix,St.spotLightMatrix.value=W.state.spotLightMatrix,St.spotLightMap.value=W.state.spotLightMap,St.pointShadowMatrix.value=W.state.pointShadowMatrix),k.numLightProbeGrids=Hf(E.state.lightProbeGridArray),k.currentProgram=$t,k.uniformsList=null,$t}function X0(S,U,$,k,W){let gt=Lt.get(S),bt=gt.currentProgram.id+","+k+","+W,pt=gt.programVariants.get(bt);return pt===void 0?(pt=Or(S,U,$),gt.programVariants.set(bt,pt)):(gt.currentProgram=pt,gt.uniformsList=null,gt.outputColorSpace=k,gt.toneMapping=W),pt}function Wf(S){if(S.uniformsList===null){let U=S.currentProgram.getUniforms();S.uniformsList=Rr.seqWithValue(U.seq,S.uniforms)}return S.uniformsList}function Xf(S,U){let $=Lt.get(S);$.outputColorSpace=U.outputColorSpace,$.batching=U.batching,$.batchingColor=U.batchingColor,$.instancing=U.instancing,$.instancingColor=U.instancingColor,$.instancingMorph=U.instancingMorph,$.skinning=U.skinning,$.morphTargets=U.morphTargets,$.morphNormals=U.morphNormals,$.morphColors=U.morphColors,$.morphTargetsCount=U.morphTargetsCount,$.numClippingPlanes=U.numClippingPlanes,$.numIntersection=U.numClipIntersection,$.vertexAlphas=U.vertexAlphas,$.vertexTangents=U.vertexTangents,$.toneMapping=U.toneMapping}function $0(S,U,$,k,W){U.isScene!==!0&&(U=mn),Ot.resetTextureUnits();let gt=U.fog,bt=k.isMeshStandardMaterial||k.isMeshLambertMaterial||k.isMeshPhongMaterial?U.environment:null,pt=j===null?R.outputColorSpace:j.isXRRenderTarget===!0?j.texture.colorSpace:Yt.workingColorSpace,vt=k.isMeshStandardMaterial||k.isMeshLambertMaterial&&!k.envMap||k.isMeshPhongMaterial&&!k.envMap,Et=T.get(k.envMap||bt,vt),Ft=k.vertexColors===!0&&!!$.attributes.color&&$.attributes.color.itemSize===4,$t=!!$.attributes.tangent&&(!!k.normalMap||k.anisotropy>0),St=!!$.morphAttributes.position,qt=!!$.morphAttributes.normal,xe=!!$.morphAttributes.color,le=Zn;k.toneMapped&&(j===null||j.isXRRenderTarget===!0)&&(le=R.toneMapping);let re=$.morphAttributes.position||$.morphAttributes.normal||$.morphAttributes.color,Be=re!==void 0?re.length:0,wt=Lt.get(k),Ye=E.state.lights;if(ae===!0&&(ve===!0||S!==Y)){let ge=S===Y&&k.id===X;Q.setState(k,S,ge)}let jt=!1,Ki=!1;k.version===wt.__version?wt.needsLights&&wt.lightsStateVersion!==Ye.state.version||W.isBatchedMesh&&wt.batching===!1||!W.isBatchedMesh&&wt.batching===!0||W.isBatchedMesh&&wt.batchingColor===!0&&W._colorsTexture===null||W.isBatchedMesh&&wt.batchingColor===!1&&W._colorsTexture!==null||W.isInstancedMesh&&wt.instancing===!1||!W.isInstancedMesh&&wt.instancing===!0||W.isSkinnedMesh&&wt.skinning===!1||!W.isSkinnedMesh&&wt.skinning===!0||W.isInstancedMesh&&wt.instancingColor===!0&&W.instanceColor===null||W.isInstancedMesh&&wt.instancingColor===!1&&W.instanceColor!==null||W.isInstancedMesh&&wt.instancingMorph===!0&&W.morphTexture===null||W.isInstancedMesh&&wt.instancingMorph===!1&&W.morphTexture!==null||wt.envMap!==Et||k.fog===!0&&wt.fog!==gt||wt.numClippingPlanes!==void 0&&(wt.numClippingPlanes!==Q.numPlanes||wt.numIntersection!==Q.numIntersection)||wt.vertexAlphas!==Ft||wt.vertexTangents!==$t||wt.morphTargets!==St||wt.morphNormals!==qt||wt.morphColors!==xe||wt.morphTargetsCount!==Be||wt.numLightProbeGrids!==Hf(E.state.lightProbeGridArray)?jt=!0:(wt.outputColorSpace!==pt||wt.toneMapping!==le)&&(Ki=!0):(jt=!0,wt.__version=k.version);let ke=wt.currentProgram;(jt===!0||Ki===!0)&&(ke=Ki===!0?X0(k,U,W,pt,le):Or(k,U,W),I&&k.isNodeMaterial&&I.onUpdateProgram(k,ke,wt));let ta=!1,Ci=!1,ji=!1,Kt=ke.getUniforms(),Le=wt.uniforms;if(xt.useProgram(ke.program)&&(ta=!0,Ci=!0,ji=!0),k.id!==X&&(X=k.id,Ci=!0),ta||Y!==S){xt.buffers.depth.getReversed()&&S.reversedDepth!==!0&&(S._reversedDepth=!0,S.updateProjectionMatrix()),Kt.setValue(F,"projectionMatrix",S.projectionMatrix),Kt.setValue(F,"viewMatrix",S.matrixWorldInverse);let Te=Kt.map.cameraPosition;Te!==void 0&&Te.setValue(F,Vn.setFromMatrixPosition(S.matrixWorld)),de.logarithmicDepthBuffer&&Kt.setValue(F,"logDepthBufFC",2/(Math.log(S.far+1)/Math.LN2)),(k.isMeshPhongMaterial||k.isMeshToonMaterial||k.isMeshLambertMaterial||k.isMeshBasicMaterial||k.isMeshStandardMaterial||k.isShaderMaterial)&&Kt.setValue(F,"isOrthographic",S.isOrthographicCamera===!0),Y!==S&&(Y=S,Ci=!0,ji=!0)}if(wt.needsLights&&(Ye.state.sunShadowMap.length>0&&Kt.setValue(F,"sunShadowMap",Ye.state.sunShadowMap,Ot),Ye.state.directionalShadowMap.length>0&&Kt.setValue(F,"directionalShadowMap",Ye.state.directionalShadowMap,Ot),Ye.state.spotShadowMap.length>0&&Kt.setValue(F,"spotShadowMap",Ye.state.spotShadowMap,Ot),Ye.state.pointShadowMap.length>0&&Kt.setValue(F,"pointShadowMap",Ye.state.pointShadowMap,Ot)),W.isSkinnedMesh){Kt.setOptional(F,W,"bindMatrix"),Kt.setOptional(F,W,"bindMatrixInverse");let ge=W.skeleton;ge&&(ge.boneTexture===null&&ge.computeBoneTexture(),Kt.setValue(F,"boneTexture",ge.boneTexture,Ot))}W.isBatchedMesh&&(Kt.setOptional(F,W,"batchingTexture"),Kt.setValue(F,"batchingTexture",W._matricesTexture,Ot),Kt.setOptional(F,W,"batchingIdTexture"),Kt.setValue(F,"batchingIdTexture",W._indirectTexture,Ot),Kt.setOptional(F,W,"batchingColorTexture"),W._colorsTexture!==null&&Kt.setValue(F,"batchingColorTexture",W._colorsTexture,Ot));let wn=$.morphAttributes;if((wn.position!==void 0||wn.normal!==void 0||wn.color!==void 0)&&tt.update(W,$,ke),(Ci||wt.receiveShadow!==W.receiveShadow)&&(wt.receiveShadow=W.receiveShadow,Kt.setValue(F,"receiveShadow",W.receiveShadow)),(k.isMeshStandardMaterial||k.isMeshLambertMaterial||k.isMeshPhongMaterial)&&k.envMap===null&&U.environment!==null&&(Le.envMapIntensity.value=U.environmentIntensity),Le.dfgLUT!==void 0&&(Le.dfgLUT.value=X1()),Ci){if(Kt.setValue(F,"toneMappingExposure",R.toneMappingExposure),wt.needsLights&&q0(Le,ji),gt&&k.fog===!0&&ht.refreshFogUniforms(Le,gt),ht.refreshMaterialUniforms(Le,k,rt,ot,E.state.transmissionRenderTarget[S.id]),wt.needsLights&&wt.numLightProbeGrids>0){let ge=v,Te=0;for(let ni of E.state.lightProbeGridArray)ni.texture!==null&&(ge.textures[Te]=ni.texture,ge.min[Te]=ni.boundingBox.min,ge.max[Te]=ni.boundingBox.max,ge.resolution[Te]=ni.resolution,Te++);for(let ni in ge)ge[ni].length=Te;Le.probesSH.value=ge.textures,Le.probesMin.value=ge.min,Le.probesMax.value=ge.max,Le.probesResolution.value=ge.resolution}Rr.upload(F,Wf(wt),Le,Ot)}if(k.isShaderMaterial&&k.uniformsNeedUpdate===!0&&(Rr.upload(F,Wf(wt),Le,Ot),k.uniformsNeedUpdate=!1),k.isSpriteMaterial&&Kt.setValue(F,"center",W.center),Kt.setValue(F,"modelViewMatrix",W.modelViewMatrix),Kt.setValue(F,"normalMatrix",W.normalMatrix),Kt.setValue(F,"modelMatrix",W.matrixWorld),k.uniformsGroups!==void 0){let ge=k.uniformsGroups;for(let Te=0,ni=ge.length;Te<ni;Te++){let qf=ge[Te];Tt.update(qf,ke),Tt.bind(qf,ke)}}return ke}function q0(S,U){S.ambientLightColor.needsUpdate=U,S.lightProbe.needsUpdate=U,S.sunLights.needsUpdate=U,S.sunLightShadows.needsUpdate=U,S.directionalLights.needsUpdate=U,S.directionalLightShadows.needsUpdate=U,S.pointLights.needsUpdate=U,S.pointLightShadows.needsUpdate=U,S.spotLights.needsUpdate=U,S.spotLightShadows.needsUpdate=U,S.rectAreaLights.needsUpdate=U,S.hemisphereLights.needsUpdate=U}function Y0(S){return S.isMeshLambertMaterial||S.isMeshToonMaterial||S.isMeshPhongMaterial||S.isMeshStandardMaterial||S.isShadowMaterial||S.isShaderMaterial&&S.lights===!0}this.getActiveCubeFace=function(){return q},this.getActiveMipmapLevel=function(){return V},this.getRenderTarget=function(){return j},this.setRenderTargetTextures=function(S,U,$){let k=Lt.get(S);k.__autoAllocateDepthBuffer=S.resolveDepthBuffer===!1,k.__autoAllocateDepthBuffer===!1&&(k.__useRenderToTexture=!1),Lt.get(S.texture).__webglTexture=U,Lt.get(S.depthTexture).__webglTexture=k.__autoAllocateDepthBuffer?void 0:$,k.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(S,U){let $=Lt.get(S);$.__webglFramebuffer=U,$.__useDefaultFramebuffer=U===void 0},this.setRenderTarget=function(S,U=0,$=0){j=S,q=U,V=$;let k=null,W=!1,gt=!1;if(S){let pt=Lt.get(S);if(pt.__useDefaultFramebuffer!==void 0){xt.bindFramebuffer(F.FRAMEBUFFER,pt.__webglFramebuffer),st.copy(S.viewport),O.copy(S.scissor),Z=S.scissorTest,xt.viewport(st),xt.scissor(O),xt.setScissorTest(Z),X=-1;return}else if(pt.__webglFramebuffer===void 0)Ot.setupRenderTarget(S);else if(pt.__hasExternalTextures)Ot.rebindTextures(S,Lt.get(S.texture).__webglTexture,Lt.get(S.depthTexture).__webglTexture);else if(S.depthBuffer){let Ft=S.depthTexture;if(pt.__boundDepthTexture!==Ft){if(Ft!==null&&Lt.has(Ft)&&(S.width!==Ft.image.width||S.height!==Ft.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");Ot.setupDepthRenderbuffer(S)}}let vt=S.texture;(vt.isData3DTexture||vt.isDataArrayTexture||vt.isCompressedArrayTexture)&&(gt=!0);let Et=Lt.get(S).__webglFramebuffer;S.isWebGLCubeRenderTarget?(Array.isArray(Et[U])?k=Et[U][$]:k=Et[U],W=!0):S.samples>0&&Ot.useMultisampledRTT(S)===!1?k=Lt.get(S).__webglMultisampledFramebuffer:Array.isArray(Et)?k=Et[$]:k=Et,st.copy(S.viewport),O.copy(S.scissor),Z=S.scissorTest}else st.copy(At).multiplyScalar(rt).floor(),O.copy(Dt).multiplyScalar(rt).floor(),Z=Xt;if($!==0&&(k=z),xt.bindFramebuffer(F.FRAMEBUFFER,k)&&xt.drawBuffers(S,k),xt.viewport(st),xt.scissor(O),xt.setScissorTest(Z),W){let pt=Lt.get(S.texture);F.framebufferTexture2D(F.FRAMEBUFFER,F.COLOR_ATTACHMENT0,F.TEXTURE_CUBE_MAP_POSITIVE_X+U,pt.__webglTexture,$)}else if(gt){let pt=U;for(let vt=0;vt<S.textures.length;vt++){let Et=Lt.get(S.textures[vt]);F.framebufferTextureLayer(F.FRAMEBUFFER,F.COLOR_ATTACHMENT0+vt,Et.__webglTexture,$,pt)}}else if(S!==null&&$!==0){let pt=Lt.get(S.texture);F.framebufferTexture2D(F.FRAMEBUFFER,F.COLOR_ATTACHMENT0,F.TEXTURE_2D,pt.__webglTexture,$)}X=-1};function $f(S){let U=Lt.get(S);return(U.__readFormat!==S.format||U.__readType!==S.type)&&(U.__readFormat=S.format,U.__readType=S.type,U.__formatReadable=de.textureFormatReadable(S.format),U.__typeReadable=de.textureTypeReadable(S.type)),U}this.readRenderTargetPixels=function(S,U,$,k,W,gt,bt,pt=0){if(!(S&&S.isWebGLRenderTarget)){Nt("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let vt=Lt.get(S).__webglFramebuffer;if(S.isWebGLCubeRenderTarget&&bt!==void 0&&(vt=vt[bt],Array.isArray(vt)&&(vt=vt[0])),vt){xt.bindFramebuffer(F.FRAMEBUFFER,vt);try{let Et=S.textures[pt],Ft=Et.format,$t=Et.type;S.textures.length>1&&F.readBuffer(F.COLOR_ATTACHMENT0+pt);let St=$f(Et);if(St.__formatReadable===!1){Nt("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(St.__typeReadable===!1){Nt("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}U>=0&&U<=S.width-k&&$>=0&&$<=S.height-W&&F.readPixels(U,$,k,W,ct.convert(Ft),ct.convert($t),gt)}finally{let Et=j!==null?Lt.get(j).__webglFramebuffer:null;xt.bindFramebuffer(F.FRAMEBUFFER,Et)}}},this.readRenderTargetPixelsAsync=async function(S,U,$,k,W,gt,bt,pt=0){if(!(S&&S.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let vt=Lt.get(S).__webglFramebuffer;if(S.isWebGLCubeRenderTarget&&bt!==void 0&&(vt=vt[bt],Array.isArray(vt)&&(vt=vt[0])),vt)if(U>=0&&U<=S.width-k&&$>=0&&$<=S.height-W){xt.bindFramebuffer(F.FRAMEBUFFER,vt);let Et=S.textures[pt],Ft=Et.format,$t=Et.type;S.textures.length>1&&F.readBuffer(F.COLOR_ATTACHMENT0+pt);let St=$f(Et);if(St.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(St.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let qt=F.createBuffer();F.bindBuffer(F.PIXEL_PACK_BUFFER,qt),F.bufferData(F.PIXEL_PACK_BUFFER,gt.byteLength,F.STREAM_READ),F.readPixels(U,$,k,W,ct.convert(Ft),ct.convert($t),0),F.bindBuffer(F.PIXEL_PACK_BUFFER,null);let xe=j!==null?Lt.get(j).__webglFramebuffer:null;xt.bindFramebuffer(F.FRAMEBUFFER,xe);let le=F.fenceSync(F.SYNC_GPU_COMMANDS_COMPLETE,0);return F.flush(),await Ug(F,le,4),F.bindBuffer(F.PIXEL_PACK_BUFFER,qt),F.getBufferSubData(F.PIXEL_PACK_BUFFER,0,gt),F.bindBuffer(F.PIXEL_PACK_BUFFER,null),F.deleteBuffer(qt),F.deleteSync(le),gt}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(S,U=null,$=0){let k=Math.pow(2,-$),W=Math.floor(S.image.width*k),gt=Math.floor(S.image.height*k),bt=U!==null?U.x:0,pt=U!==null?U.y:0;Ot.setTexture2D(S,0),F.copyTexSubImage2D(F.TEXTURE_2D,$,0,0,bt,pt,W,gt),xt.unbindTexture()},this.copyTextureToTexture=function(S,U,$=null,k=null,W=0,gt=0){let bt,pt,vt,Et,Ft,$t,St,qt,xe,le=S.isCompressedTexture?S.mipmaps[gt]:S.image;if($!==null)bt=$.max.x-$.min.x,pt=$.max.y-$.min.y,vt=$.isBox3?$.max.z-$.min.z:1,Et=$.min.x,Ft=$.min.y,$t=$.isBox3?$.min.z:0;else{let Kt=Math.pow(2,-W);bt=Math.floor(le.width*Kt),pt=Math.floor(le.height*Kt),S.isDataArrayTexture?vt=le.depth:S.isData3DTexture?vt=Math.floor(le.depth*Kt):vt=1,Et=0,Ft=0,$t=0}k!==null?(St=k.x,qt=k.y,xe=k.z):(St=0,qt=0,xe=0);let re=ct.convert(U.format),Be=ct.convert(U.type),wt;U.isData3DTexture?(Ot.setTexture3D(U,0),wt=F.TEXTURE_3D):U.isDataArrayTexture||U.isCompressedArrayTexture?(Ot.setTexture2DArray(U,0),wt=F.TEXTURE_2D_ARRAY):(Ot.setTexture2D(U,0),wt=F.TEXTURE_2D),xt.activeTexture(F.TEXTURE0),xt.pixelStorei(F.UNPACK_FLIP_Y_WEBGL,U.flipY),xt.pixelStorei(F.UNPACK_PREMULTIPLY_ALPHA_WEBGL,U.premultiplyAlpha),xt.pixelStorei(F.UNPACK_ALIGNMENT,U.unpackAlignment);let Ye=xt.getParameter(F.UNPACK_ROW_LENGTH),jt=xt.getParameter(F.UNPACK_IMAGE_HEIGHT),Ki=xt.getParameter(F.UNPACK_SKIP_PIXELS),ke=xt.getParameter(F.UNPACK_SKIP_ROWS),ta=xt.getParameter(F.UNPACK_SKIP_IMAGES);xt.pixelStorei(F.UNPACK_ROW_LENGTH,le.width),xt.pixelStorei(F.UNPACK_IMAGE_HEIGHT,le.height),xt.pixelStorei(F.UNPACK_SKIP_PIXELS,Et),xt.pixelStorei(F.UNPACK_SKIP_ROWS,Ft),xt.pixelStorei(F.UNPACK_SKIP_IMAGES,$t);let Ci=S.isDataArrayTexture||S.isData3DTexture,ji=U.isDataArrayTexture||U.isData3DTexture;if(S.isDepthTexture){let Kt=Lt.get(S),Le=Lt.get(U),wn=Lt.get(Kt.__renderTarget),ge=Lt.get(Le.__renderTarget);xt.bindFramebuffer(F.READ_FRAMEBUFFER,wn.__webglFramebuffer),xt.bindFramebuffer(F.DRAW_FRAMEBUFFER,ge.__webglFramebuffer);for(let Te=0;Te<vt;Te++)Ci&&(F.framebufferTextureLayer(F.READ_FRAMEBUFFER,F.COLOR_ATTACHMENT0,Lt.get(S).__webglTexture,W,$t+Te),F.framebufferTextureLayer(F.DRAW_FRAMEBUFFER,F.COLOR_ATTACHMENT0,Lt.get(U).__webglTexture,gt,xe+Te)),F.blitFramebuffer(Et,Ft,Et+bt,Ft+pt,St,qt,St+bt,qt+pt,F.DEPTH_BUFFER_BIT,F.NEAREST);xt.bindFramebuffer(F.READ_FRAMEBUFFER,null),xt.bindFramebuffer(F.DRAW_FRAMEBUFFER,null)}else if(W!==0||S.isRenderTargetTexture||Lt.has(S)){let Kt=Lt.get(S),Le=Lt.get(U);xt.bindFramebuffer(F.READ_FRAMEBUFFER,C),xt.bindFramebuffer(F.DRAW_FRAMEBUFFER,H);for(let wn=0;wn<vt;wn++)Ci?F.framebufferTextureLayer(F.READ_FRAMEBUFFER,F.COLOR_ATTACHMENT0,Kt.__webglTexture,W,$t+wn):F.framebufferTexture2D(F.READ_FRAMEBUFFER,F.COLOR_ATTACHMENT0,F.TEXTURE_2D,Kt.__webglTexture,W),ji?F.framebufferTextureLayer(F.DRAW_FRAMEBUFFER,F.COLOR_ATTACHMENT0,Le.__webglTexture,gt,xe+wn):F.framebufferTexture2D(F.DRAW_FRAMEBUFFER,F.COLOR_ATTACHMENT0,F.TEXTURE_2D,Le.__webglTexture,gt),W!==0?F.blitFramebuffer(Et,Ft,Et+bt,Ft+pt,St,qt,St+bt,qt+pt,F.COLOR_BUFFER_BIT,F.NEAREST):ji?F.copyTexSubImage3D(wt,gt,St,qt,xe+wn,Et,Ft,bt,pt):F.copyTexSubImage2D(wt,gt,St,qt,Et,Ft,bt,pt);xt.bindFramebuffer(F.READ_FRAMEBUFFER,null),xt.bindFramebuffer(F.DRAW_FRAMEBUFFER,null)}else ji?S.isDataTexture||S.isData3DTexture?F.texSubImage3D(wt,gt,St,qt,xe,bt,pt,vt,re,Be,le.data):U.isCompressedArrayTexture?F.compressedTexSubImage3D(wt,gt,St,qt,xe,bt,pt,vt,re,le.data):F.texSubImage3D(wt,gt,St,qt,xe,bt,pt,vt,re,Be,le):S.isDataTexture?F.texSubImage2D(F.TEXTURE_2D,gt,St,qt,bt,pt,re,Be,le.data):S.isCompressedTexture?F.compressedTexSubImage2D(F.TEXTURE_2D,gt,St,qt,le.width,le.height,re,le.data):F.texSubImage2D(F.TEXTURE_2D,gt,St,qt,bt,pt,re,Be,le);xt.pixelStorei(F.UNPACK_ROW_LENGTH,Ye),xt.pixelStorei(F.UNPACK_IMAGE_HEIGHT,jt),xt.pixelStorei(F.UNPACK_SKIP_PIXELS,Ki),xt.pixelStorei(F.UNPACK_SKIP_ROWS,ke),xt.pixelStorei(F.UNPACK_SKIP_IMAGES,ta),gt===0&&U.generateMipmaps===!0&&U.mipmapsAutoUpdate===!0&&F.generateMipmap(wt),xt.unbindTexture()},this.initRenderTarget=function(S){Lt.get(S).__webglFramebuffer===void 0&&Ot.setupRenderTarget(S)},this.initTexture=function(S){S.isCubeTexture?Ot.setTextureCube(S,0):S.isData3DTexture?Ot.setTexture3D(S,0):S.isDataArrayTexture||S.isCompressedArrayTexture?Ot.setTexture2DArray(S,0):Ot.setTexture2D(S,0),xt.unbindTexture()},this.resetState=function(){q=0,V=0,j=null,xt.reset(),ut.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return bn}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(t){this._outputColorSpace=t;let e=this.getContext();e.drawingBufferColorSpace=Yt._getDrawingBufferColorSpace(t),e.unpackColorSpace=Yt._getUnpackColorSpace()}};var $1={white:"#f4f1e8",yellow:"#f0c43c",red:"#c63a32",blue:"#3569b0",green:"#2f8559",black:"#33353a",pink:"#dd8fa6",brown:"#8a5a3a"},x0=["#f4f1e8","#c63a32","#f0c43c","#3569b0","#2f8559","#d9822b","#7d4fa0","#8a5a3a","#dd8fa6","#4aa3a2"],Ir=(n,t)=>$1[n.name??""]??x0[t%x0.length];function q1(n,t){let e=document.createElement("canvas");e.width=256,e.height=128;let i=e.getContext("2d");i.fillStyle=n,i.fillRect(0,0,256,128),i.fillStyle=t;let s=(o,a)=>{i.beginPath(),i.ellipse(o,a,12/Math.max(Math.sin(a/128*Math.PI),.05),12,0,0,7),i.fill()};for(let o of[32,96,160,224])s(o,64);i.fillRect(0,0,256,12),i.fillRect(0,116,256,12);let r=new Mr(e);return r.colorSpace=Je,r}var Cf=null;function Y1(){if(Cf)return Cf;let n=document.createElement("canvas");n.width=n.height=128;let t=n.getContext("2d"),e=t.createRadialGradient(64,64,20,64,64,64);return e.addColorStop(0,"rgba(0,0,0,1)"),e.addColorStop(.55,"rgba(0,0,0,0.75)"),e.addColorStop(1,"rgba(0,0,0,0)"),t.fillStyle=e,t.fillRect(0,0,128,128),Cf=new Mr(n)}var Z1=new ys(1,40,20).rotateX(Math.PI/2),J1=new Mo(1,32),K1=new xs(1.16,1.34,48),Xc=class{constructor(t,e,{ghost:i=!1,halo:s=null,floor:r,dark:o}){this.radius=1,this.group=new Xe;let a=q1(t,e),c=new vs({map:a,transparent:i,opacity:i?.55:1,depthWrite:!0});if(this.ball=new _e(Z1,c),this.group.add(this.ball),this.shadow=null,r){let l=new On({map:Y1(),transparent:!0,opacity:(o?.75:.42)*(i?.5:1),depthWrite:!1});this.shadow=new _e(J1,l),this.group.add(this.shadow)}this.halo=null,s&&r&&(this.halo=new _e(K1,new On({color:new zt(s),transparent:!0,opacity:i?.8:1,depthWrite:!1})),this.group.add(this.halo))}resize(t){this.radius=t,this.ball.scale.setScalar(t),this.halo?.scale.setScalar(t)}place(t,e,i){if(this.group.visible=i>.02*this.radius,!this.group.visible)return;i<1/0&&(this.ball.material.opacity=.6*Math.min(1,i/this.radius)),this.ball.position.set(t[0],t[1],t[2]),this.ball.quaternion.set(e[1],e[2],e[3],e[0]);let s=Math.max(0,t[2]-this.radius);this.shadow&&(this.shadow.position.set(t[0]-.5*s-.06*this.radius,t[1]+1.4*s+.14*this.radius,.004*this.radius),this.shadow.scale.setScalar(this.radius*(1.12+Math.min(1,.25*s/this.radius)))),this.halo&&this.halo.position.set(t[0],t[1],.008*this.radius)}};var b0=[{name:"free",label:"3-D"},{name:"above",label:"Above"},{name:"side",label:"Side"},{name:"along",label:"Along the wall"}],M0=1e4,Lr=n=>.16*Kn(n.box)/Math.max(1,Math.hypot(...n.scene.balls[n.ball].velocity)/2||1),Kn=({low:n,high:t})=>Math.max(t[0]-n[0],t[1]-n[1],.001),Nr=({low:n,high:t})=>[(n[0]+t[0])/2,(n[1]+t[1])/2,(n[2]+t[2])/2];function Ko(n,t){let e=1.2*Kn(t),i=Nr(t),s=(r,o)=>{let a=Math.hypot(o[0],o[1]);if(a<1e-6)return[];let[c,l]=[o[0]/a,o[1]/a],h=((r[0]-i[0])*o[0]+(r[1]-i[1])*o[1]+r[2]*o[2])/a,[u,f]=[i[0]+h*c,i[1]+h*l];return[[u-e*-l,f-e*c],[u+e*-l,f+e*c]]};switch(n.shape){case"plane":return[s(n.point,Ge(n.normal))];case"strip":{let r=Ge(n.normal),o=n.point.map((a,c)=>a+n.width*r[c]);return[s(n.point,r),s(o,r)]}case"wedge":{let r=[n.from_angle,n.to_angle].map(c=>c*Math.PI/180),[o,a]=n.apex;return[r.map(c=>[o+e*Math.cos(c),a+e*Math.sin(c)])].map(([c,l])=>[c,[o,a],l])}case"segment":return[[n.start,n.end]];case"polygon":return[n.closed?[...n.points,n.points[0]]:n.points];case"table":{let[r,o]=n.center;return[y0(r-n.length/2,o-n.width/2,r+n.length/2,o+n.width/2)]}case"box":{let[r,o]=Rf(n);return[y0(r[0],r[1],o[0],o[1])]}case"sphere":return[Jo(n.center,n.radius,0,360)];case"cylinder":return[Jo(n.point,n.radius,0,360)];case"arc":return[Jo(n.center,n.radius,n.from_angle,n.to_angle)];case"stadium":{let[r,o]=[Math.cos(n.angle*Math.PI/180),Math.sin(n.angle*Math.PI/180)],a=n.length/2,c=[1,-1].map(h=>[n.center[0]+h*a*r,n.center[1]+h*a*o]),l=[...Jo(c[0],n.radius,n.angle-90,n.angle+90),...Jo(c[1],n.radius,n.angle+90,n.angle+270)];return[[...l,l[0]]]}default:return[]}}var y0=(n,t,e,i)=>[[n,t],[e,t],[e,i],[n,i],[n,t]];function Jo(n,t,e,i){let s=Math.max(8,Math.ceil(Math.abs(i-e)/4));return Array.from({length:s+1},(r,o)=>{let a=(e+(i-e)*o/s)*Math.PI/180;return[n[0]+t*Math.cos(a),n[1]+t*Math.sin(a)]})}function Rf(n){let t=n.corner??n.center.map((e,i)=>e-n.size[i]/2);return[t,t.map((e,i)=>e+n.size[i])]}var j1=["table","box","segment","polygon","sphere","arc","stadium"],v0=n=>j1.includes(n.shape)||n.shape==="cylinder"&&Math.abs(Ge(n.axis)[2])>.99&&n.radius<M0;function jo(n,t,e,i){let s=[1/0,1/0,n.floor?0:1/0],r=[-1/0,-1/0,-1/0],o=(f,d=0)=>{for(let g=0;g<f.length;g++)Math.abs(f[g])>M0||(s[g]=Math.min(s[g],f[g]-d),r[g]=Math.max(r[g],f[g]+d))},a={low:[0,0,0],high:[0,0,0]},c=n.walls.some(f=>v0(f)&&f.shape!=="segment");for(let f of n.walls)if(v0(f))for(let d of Ko(f,a))for(let g of d)o(g);n.balls.forEach(f=>o(f.position,f.radius));let l=f=>f.map((d,g)=>Math.max(s[g]-h,Math.min(r[g]+h,d))),h=1/0;for(let f of new Set([e,...t.keys()])){let d=t.get(f);d?.balls.forEach(({pieces:g},_)=>{let m=n.balls[_].radius,[p,y]=n.balls[_].position;for(let{points:b}of Fs(g,i,m))for(let v of b)o(c?[p,y,v[2]]:h<1/0?l(v):v,m)}),d&&h===1/0&&(h=.25*Math.max(r[0]-s[0],r[1]-s[1]))}let u=10*Math.max(...n.balls.map(f=>f.radius));for(let f of[0,1]){let d=(u-(r[f]-s[f]))/2;d>0&&(s[f]-=d,r[f]+=d)}return{low:s,high:r}}function $c(n,t,e){let i=Math.max(...t.balls.map(c=>c.radius)),s=ns(n.low??"-inf"),r=ns(n.height??"inf"),o=t.floor?0:Math.min(e.low[2],-i),a=Math.max(o+1.7*i,Math.min(e.high[2],o+8*i));return[Math.max(s,o),Math.min(r,a)]}var Q1={rolling:[],sliding:[7,4],flight:[1.5,3.5]},S0=24,w0=1.8;function E0(n,t){let e=document.createElement("canvas");e.tabIndex=0,e.setAttribute("role","img"),n.prepend(e);let i=null,s=null,r=0,o=!1,a=null,c=[0,0],l=1,h=[];function u(p){let[y,b]=[n.clientWidth,n.clientHeight],{low:v,high:A}=p.box,E=Math.min(.3*b,150),x=Math.min((y-40)/(A[0]-v[0]),(b-E-50)/(A[1]-v[1])),[w,D]=[(v[0]+A[0])/2,(v[1]+A[1])/2],R=Math.max(A[2]-v[2],1e-6),L=Math.min(x,(E-50)/R);return{width:y,height:b,k:x,up:L,strip:E,above:(I,z)=>[y/2+x*(I-w),(b-E)/2-x*(z-D)],side:(I,z)=>[y/2+x*(I-w),b-34-L*(z-v[2])],metres:(I,z)=>[w+(I-y/2)/x,D-(z-(b-E)/2)/x]}}function f(){if(!i)return[0,0];let{position:p,velocity:y,radius:b}=i.scene.balls[i.ball],v=Math.hypot(y[0],y[1]),A=v>0?[y[0]/v,y[1]/v]:[1,0],E=w0*b+v*l;return[p[0]+A[0]*E,p[1]+A[1]*E]}e.addEventListener("pointerdown",p=>{if(!i||p.button!==0)return;let y=u(i),b=i.scene.balls[i.ball],v=w=>Math.hypot(w[0]-p.offsetX,w[1]-p.offsetY),A=f();if(v(y.above(A[0],A[1]))<S0)a="velocity";else if(v(y.above(b.position[0],b.position[1]))<Math.max(S0,y.k*b.radius))a="ball";else return;let E=y.metres(p.offsetX,p.offsetY),x=a==="ball"?b.position:A;c=[x[0]-E[0],x[1]-E[1]],e.setPointerCapture(p.pointerId),t.start()}),e.addEventListener("pointermove",p=>{if(!a||!i)return;let[y,b]=u(i).metres(p.offsetX,p.offsetY).map((w,D)=>w+c[D]);if(a==="ball"){t.ball(y,b);return}let{position:v,radius:A}=i.scene.balls[i.ball],E=Math.hypot(y-v[0],b-v[1]),x=Math.max(0,E-w0*A)/l;t.velocity(x*(y-v[0])/(E||1),x*(b-v[1])/(E||1))});let d=()=>{a&&(a=null,i&&(l=Lr(i)),t.end(),_())};e.addEventListener("pointerup",d),e.addEventListener("pointercancel",d);function g(p,y){i=p,s=y,a||(l=Lr(p)),h=[];for(let[b,v]of p.runs)v.balls.forEach(({pieces:A},E)=>{(b===p.followed||E===p.ball)&&h.push({law:b,ball:E,turns:new Os(A)})});_()}function _(){o||(o=!0,requestAnimationFrame(m))}function m(){if(o=!1,!i||!s)return;let p=u(i),y=Math.min(devicePixelRatio,2);(e.width!==Math.round(p.width*y)||e.height!==Math.round(p.height*y))&&(e.width=Math.round(p.width*y),e.height=Math.round(p.height*y),e.style.width=`${p.width}px`,e.style.height=`${p.height}px`);let b=e.getContext("2d");b.setTransform(y,0,0,y,0,0),b.fillStyle=s.background,b.fillRect(0,0,p.width,p.height),b.strokeStyle=s.edge,b.lineWidth=2;for(let w of i.scene.walls)for(let D of Ko(w,i.box))b.beginPath(),D.forEach(([R,L])=>b.lineTo(...Zi(p.above(R,L)))),b.stroke();b.fillStyle=s.floor,b.fillRect(0,p.height-p.strip,p.width,p.strip),b.fillStyle=s.soft,b.font="12px system-ui, sans-serif",b.fillText("from above",12,20),b.fillText(p.up<p.k*.99?"from the side (heights reduced)":"from the side",12,p.height-p.strip+18),i.scene.floor&&(b.strokeStyle=s.edge,b.beginPath(),b.moveTo(...Zi(p.side(i.box.low[0]-1e3,0))),b.lineTo(...Zi(p.side(i.box.high[0]+1e3,0))),b.stroke());for(let{law:w,ball:D,turns:R}of h){b.strokeStyle=D===i.ball?i.colours.get(w)??s.ink:Ir(i.scene.balls[D],D),b.lineWidth=w===i.followed&&D===i.ball?2.4:1.4;for(let{style:L,points:I}of Fs(R.pieces,i.until,i.scene.balls[D].radius)){b.setLineDash(Q1[L]);for(let z of[C=>p.above(C[0],C[1]),C=>p.side(C[0],C[2])])b.beginPath(),I.forEach(C=>b.lineTo(...Zi(z(C)))),b.stroke()}b.setLineDash([])}let v=f(),A=i.scene.balls[i.ball].position;b.strokeStyle=b.fillStyle=s.ink,b.lineWidth=2,b.beginPath(),b.moveTo(...Zi(p.above(A[0],A[1]))),b.lineTo(...Zi(p.above(v[0],v[1]))),b.stroke(),b.beginPath(),b.arc(...Zi(p.above(v[0],v[1])),5,0,7),b.fill(),[e.dataset.ball,e.dataset.arrow]=[A,v].map(w=>p.above(w[0],w[1]).map(Math.round).join());let E=i.runs.get(i.followed),x=E?ai(E.balls[i.ball].pieces,r).x:null;for(let{law:w,ball:D,turns:R}of[...h].reverse()){let{x:L}=ai(R.pieces,r),I=w===i.followed;if(!I&&x&&Math.hypot(L[0]-x[0],L[1]-x[1],L[2]-x[2])<.02*i.scene.balls[D].radius)continue;let z=I?Ir(i.scene.balls[D],D):i.colours.get(w)??s.ink,C=Math.max(3,p.k*i.scene.balls[D].radius),[H,q,V,j]=R.at(r),X=[1-2*(V*V+j*j),2*(q*V+H*j),2*(q*j-H*V)];for(let[Y,st,O,Z]of[[p.above(L[0],L[1]),X[0],-X[1],X[2]],[p.side(L[0],L[2]),X[0],-X[2],-X[1]]])b.globalAlpha=I?1:.55,b.fillStyle=z,b.strokeStyle=s.edge,b.lineWidth=1,b.beginPath(),b.arc(...Zi(Y),C,0,7),b.fill(),b.stroke(),Z>0&&(b.fillStyle=s.ink,b.beginPath(),b.arc(Y[0]+C*st,Y[1]+C*O,Math.max(1.2,.2*C),0,7),b.fill()),b.globalAlpha=1}}return{update:g,draw(p){r=p,_()},look:()=>_(),resize:()=>_(),picture(){return m(),new Promise((p,y)=>e.toBlob(b=>b?p(b):y(new Error("The browser gave no picture.")),"image/png"))}}}var Zi=n=>[n[0],n[1]];var A0={type:"change"},If={type:"start"},C0={type:"end"},qc=new Fi,T0=new Ke,tE=Math.cos(70*Wo.DEG2RAD),we=new N,ln=2*Math.PI,Qt={NONE:-1,ROTATE:0,DOLLY:1,PAN:2,TOUCH_ROTATE:3,TOUCH_PAN:4,TOUCH_DOLLY_PAN:5,TOUCH_DOLLY_ROTATE:6},Pf=1e-6,Yc=class extends Uo{constructor(t,e=null){super(t,e),this.state=Qt.NONE,this.target=new N,this.cursor=new N,this.minDistance=0,this.maxDistance=1/0,this.minZoom=0,this.maxZoom=1/0,this.minTargetRadius=0,this.maxTargetRadius=1/0,this.minPolarAngle=0,this.maxPolarAngle=Math.PI,this.minAzimuthAngle=-1/0,this.maxAzimuthAngle=1/0,this.enableDamping=!1,this.dampingFactor=.05,this.enableZoom=!0,this.zoomSpeed=1,this.enableRotate=!0,this.rotateSpeed=1,this.keyRotateSpeed=1,this.enablePan=!0,this.panSpeed=1,this.screenSpacePanning=!0,this.keyPanSpeed=7,this.zoomToCursor=!1,this.autoRotate=!1,this.autoRotateSpeed=2,this.keys={LEFT:"ArrowLeft",UP:"ArrowUp",RIGHT:"ArrowRight",BOTTOM:"ArrowDown"},this.mouseButtons={LEFT:Wi.ROTATE,MIDDLE:Wi.DOLLY,RIGHT:Wi.PAN},this.touches={ONE:Xi.ROTATE,TWO:Xi.DOLLY_PAN},this.target0=this.target.clone(),this.position0=this.object.position.clone(),this.zoom0=this.object.zoom,this._cursorStyle="auto",this._domElementKeyEvents=null,this._lastPosition=new N,this._lastQuaternion=new Ne,this._lastTargetPosition=new N,this._quat=new Ne().setFromUnitVectors(t.up,new N(0,1,0)),this._quatInverse=this._quat.clone().invert(),this._spherical=new wr,this._sphericalDelta=new wr,this._scale=1,this._panOffset=new N,this._rotateStart=new Ct,this._rotateEnd=new Ct,this._rotateDelta=new Ct,this._panStart=new Ct,this._panEnd=new Ct,this._panDelta=new Ct,this._dollyStart=new Ct,this._dollyEnd=new Ct,this._dollyDelta=new Ct,this._dollyDirection=new N,this._mouse=new Ct,this._performCursorZoom=!1,this._pointers=[],this._pointerPositions={},this._controlActive=!1,this._onPointerMove=nE.bind(this),this._onPointerDown=eE.bind(this),this._onPointerUp=iE.bind(this),this._onContextMenu=hE.bind(this),this._onMouseWheel=oE.bind(this),this._onKeyDown=aE.bind(this),this._onTouchStart=lE.bind(this),this._onTouchMove=cE.bind(this),this._onMouseDown=sE.bind(this),this._onMouseMove=rE.bind(this),this._interceptControlDown=uE.bind(this),this._interceptControlUp=fE.bind(this),this.domElement!==null&&this.connect(this.domElement),this.update()}set cursorStyle(t){this._cursorStyle=t,t==="grab"?this.domElement.style.cursor="grab":this.domElement.style.cursor="auto"}get cursorStyle(){return this._cursorStyle}connect(t){super.connect(t),this.domElement.addEventListener("pointerdown",this._onPointerDown),this.domElement.addEventListener("pointercancel",this._onPointerUp),this.domElement.addEventListener("contextmenu",this._onContextMenu),this.domElement.addEventListener("wheel",this._onMouseWheel,{passive:!1}),this.domElement.ownerDocument.addEventListener("keydown",this._interceptControlDown,{passive:!0,capture:!0}),this.domElement.style.touchAction="none"}disconnect(){this.state=Qt.NONE,this.domElement.removeEventListener("pointerdown",this._onPointerDown),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.domElement.removeEventListener("pointercancel",this._onPointerUp),this.domElement.removeEventListener("wheel",this._onMouseWheel),this.domElement.removeEventListener("contextmenu",this._onContextMenu),this.stopListenToKeyEvents(),this.domElement.ownerDocument.removeEventListener("keydown",this._interceptControlDown,{capture:!0}),this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{capture:!0}),this._controlActive=!1,this._pointers.length=0,this._pointerPositions={},this.domElement.style.touchAction="",this.domElement.style.cursor="auto"}dispose(){this.disconnect()}getPolarAngle(){return this._spherical.phi}getAzimuthalAngle(){return this._spherical.theta}getDistance(){return this.object.position.distanceTo(this.target)}listenToKeyEvents(t){t.addEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=t}stopListenToKeyEvents(){this._domElementKeyEvents!==null&&(this._domElementKeyEvents.removeEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=null)}saveState(){this.target0.copy(this.target),this.position0.copy(this.object.position),this.zoom0=this.object.zoom}reset(){this.target.copy(this.target0),this.object.position.copy(this.position0),this.object.zoom=this.zoom0,this.object.updateProjectionMatrix(),this.dispatchEvent(A0),this.update(),this.state=Qt.NONE}pan(t,e){this._pan(t,e),this.update()}dollyIn(t){this._dollyIn(t),this.update()}dollyOut(t){this._dollyOut(t),this.update()}rotateLeft(t){this._rotateLeft(t),this.update()}rotateUp(t){this._rotateUp(t),this.update()}update(t=null){let e=this.object.position;we.copy(e).sub(this.target),we.applyQuaternion(this._quat),this._spherical.setFromVector3(we),this.autoRotate&&this.state===Qt.NONE&&this._rotateLeft(this._getAutoRotationAngle(t)),this.enableDamping?(this._spherical.theta+=this._sphericalDelta.theta*this.dampingFactor,this._spherical.phi+=this._sphericalDelta.phi*this.dampingFactor):(this._spherical.theta+=this._sphericalDelta.theta,this._spherical.phi+=this._sphericalDelta.phi);let i=this.minAzimuthAngle,s=this.maxAzimuthAngle;isFinite(i)&&isFinite(s)&&(i<-Math.PI?i+=ln:i>Math.PI&&(i-=ln),s<-Math.PI?s+=ln:s>Math.PI&&(s-=ln),i<=s?this._spherical.theta=Math.max(i,Math.min(s,this._spherical.theta)):this._spherical.theta=this._spherical.theta>(i+s)/2?Math.max(i,this._spherical.theta):Math.min(s,this._spherical.theta)),this._spherical.phi=Math.max(this.minPolarAngle,Math.min(this.maxPolarAngle,this._spherical.phi)),this._spherical.makeSafe(),this.enableDamping===!0?this.target.addScaledVector(this._panOffset,this.dampingFactor):this.target.add(this._panOffset),this.target.sub(this.cursor),this.target.clampLength(this.minTargetRadius,this.maxTargetRadius),this.target.add(this.cursor);let r=!1;if(this.zoomToCursor&&this._performCursorZoom||this.object.isOrthographicCamera)this._spherical.radius=this._clampDistance(this._spherical.radius);else{let o=this._spherical.radius;this._spherical.radius=this._clampDistance(this._spherical.radius*this._scale),r=o!=this._spherical.radius}if(we.setFromSpherical(this._spherical),we.applyQuaternion(this._quatInverse),e.copy(this.target).add(we),this.object.lookAt(this.target),this.enableDamping===!0?(this._sphericalDelta.theta*=1-this.dampingFactor,this._sphericalDelta.phi*=1-this.dampingFactor,this._panOffset.multiplyScalar(1-this.dampingFactor)):(this._sphericalDelta.set(0,0,0),this._panOffset.set(0,0,0)),this.zoomToCursor&&this._performCursorZoom){let o=null;if(this.object.isPerspectiveCamera){let a=we.length();o=this._clampDistance(a*this._scale);let c=a-o;this.object.position.addScaledVector(this._dollyDirection,c),this.object.updateMatrixWorld(),r=!!c}else if(this.object.isOrthographicCamera){let a=new N(this._mouse.x,this._mouse.y,0);a.unproject(this.object);let c=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),this.object.updateProjectionMatrix(),r=c!==this.object.zoom;let l=new N(this._mouse.x,this._mouse.y,0);l.unproject(this.object),this.object.position.sub(l).add(a),this.object.updateMatrixWorld(),o=we.length()}else console.warn("WARNING: OrbitControls.js encountered an unknown camera type - zoom to cursor disabled."),this.zoomToCursor=!1;o!==null&&(this.screenSpacePanning?this.target.set(0,0,-1).transformDirection(this.object.matrix).multiplyScalar(o).add(this.object.position):(qc.origin.copy(this.object.position),qc.direction.set(0,0,-1).transformDirection(this.object.matrix),Math.abs(this.object.up.dot(qc.direction))<tE?this.object.lookAt(this.target):(T0.setFromNormalAndCoplanarPoint(this.object.up,this.target),qc.intersectPlane(T0,this.target))))}else if(this.object.isOrthographicCamera){let o=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),o!==this.object.zoom&&(this.object.updateProjectionMatrix(),r=!0)}return this._scale=1,this._performCursorZoom=!1,r||this._lastPosition.distanceToSquared(this.object.position)>Pf||8*(1-this._lastQuaternion.dot(this.object.quaternion))>Pf||this._lastTargetPosition.distanceToSquared(this.target)>Pf?(this.dispatchEvent(A0),this._lastPosition.copy(this.object.position),this._lastQuaternion.copy(this.object.quaternion),this._lastTargetPosition.copy(this.target),!0):!1}_getAutoRotationAngle(t){return t!==null?ln/60*this.autoRotateSpeed*t:ln/60/60*this.autoRotateSpeed}_getZoomScale(t){let e=Math.abs(t*.01);return Math.pow(.95,this.zoomSpeed*e)}_rotateLeft(t){this._sphericalDelta.theta-=t}_rotateUp(t){this._sphericalDelta.phi-=t}_panLeft(t,e){we.setFromMatrixColumn(e,0),we.multiplyScalar(-t),this._panOffset.add(we)}_panUp(t,e){this.screenSpacePanning===!0?we.setFromMatrixColumn(e,1):(we.setFromMatrixColumn(e,0),we.crossVectors(this.object.up,we)),we.multiplyScalar(t),this._panOffset.add(we)}_pan(t,e){let i=this.domElement;if(this.object.isPerspectiveCamera){let s=this.object.position;we.copy(s).sub(this.target);let r=we.length();r*=Math.tan(this.object.fov/2*Math.PI/180),this._panLeft(2*t*r/i.clientHeight,this.object.matrix),this._panUp(2*e*r/i.clientHeight,this.object.matrix)}else this.object.isOrthographicCamera?(this._panLeft(t*(this.object.right-this.object.left)/this.object.zoom/i.clientWidth,this.object.matrix),this._panUp(e*(this.object.top-this.object.bottom)/this.object.zoom/i.clientHeight,this.object.matrix)):(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - pan disabled."),this.enablePan=!1)}_dollyOut(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale/=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_dollyIn(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale*=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_updateZoomParameters(t,e){if(!this.zoomToCursor)return;this._performCursorZoom=!0;let i=this.domElement.getBoundingClientRect(),s=t-i.left,r=e-i.top,o=i.width,a=i.height;this._mouse.x=s/o*2-1,this._mouse.y=-(r/a)*2+1,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()}_clampDistance(t){return Math.max(this.minDistance,Math.min(this.maxDistance,t))}_handleMouseDownRotate(t){this._rotateStart.set(t.clientX,t.clientY)}_handleMouseDownDolly(t){this._updateZoomParameters(t.clientX,t.clientY),this._dollyStart.set(t.clientX,t.clientY)}_handleMouseDownPan(t){this._panStart.set(t.clientX,t.clientY)}_handleMouseMoveRotate(t){this._rotateEnd.set(t.clientX,t.clientY),this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let e=this.domElement;this._rotateLeft(ln*this._rotateDelta.x/e.clientHeight),this._rotateUp(ln*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd),this.update()}_handleMouseMoveDolly(t){this._dollyEnd.set(t.clientX,t.clientY),this._dollyDelta.subVectors(this._dollyEnd,this._dollyStart),this._dollyDelta.y>0?this._dollyOut(this._getZoomScale(this._dollyDelta.y)):this._dollyDelta.y<0&&this._dollyIn(this._getZoomScale(this._dollyDelta.y)),this._dollyStart.copy(this._dollyEnd),this.zoomToCursor&&(this._performCursorZoom=!0,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()),this.update()}_handleMouseMovePan(t){this._panEnd.set(t.clientX,t.clientY),this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd),this.update()}_handleMouseWheel(t){this._updateZoomParameters(t.clientX,t.clientY),t.deltaY<0?this._dollyIn(this._getZoomScale(t.deltaY)):t.deltaY>0&&this._dollyOut(this._getZoomScale(t.deltaY)),this.update()}_handleKeyDown(t){let e=!1;switch(t.code){case this.keys.UP:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateUp(ln*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,this.keyPanSpeed),e=!0;break;case this.keys.BOTTOM:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateUp(-ln*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,-this.keyPanSpeed),e=!0;break;case this.keys.LEFT:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateLeft(ln*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(this.keyPanSpeed,0),e=!0;break;case this.keys.RIGHT:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateLeft(-ln*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(-this.keyPanSpeed,0),e=!0;break}e&&(t.preventDefault(),this.update())}_handleTouchStartRotate(t){if(this._pointers.length===1)this._rotateStart.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),i=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._rotateStart.set(i,s)}}_handleTouchStartPan(t){if(this._pointers.length===1)this._panStart.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),i=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._panStart.set(i,s)}}_handleTouchStartDolly(t){let e=this._getSecondPointerPosition(t),i=t.pageX-e.x,s=t.pageY-e.y,r=Math.sqrt(i*i+s*s);this._dollyStart.set(0,r)}_handleTouchStartDollyPan(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enablePan&&this._handleTouchStartPan(t)}_handleTouchStartDollyRotate(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enableRotate&&this._handleTouchStartRotate(t)}_handleTouchMoveRotate(t){if(this._pointers.length==1)this._rotateEnd.set(t.pageX,t.pageY);else{let i=this._getSecondPointerPosition(t),s=.5*(t.pageX+i.x),r=.5*(t.pageY+i.y);this._rotateEnd.set(s,r)}this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let e=this.domElement;this._rotateLeft(ln*this._rotateDelta.x/e.clientHeight),this._rotateUp(ln*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd)}_handleTouchMovePan(t){if(this._pointers.length===1)this._panEnd.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),i=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._panEnd.set(i,s)}this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd)}_handleTouchMoveDolly(t){let e=this._getSecondPointerPosition(t),i=t.pageX-e.x,s=t.pageY-e.y,r=Math.sqrt(i*i+s*s);this._dollyEnd.set(0,r),this._dollyDelta.set(0,Math.pow(this._dollyEnd.y/this._dollyStart.y,this.zoomSpeed)),this._dollyOut(this._dollyDelta.y),this._dollyStart.copy(this._dollyEnd);let o=(t.pageX+e.x)*.5,a=(t.pageY+e.y)*.5;this._updateZoomParameters(o,a)}_handleTouchMoveDollyPan(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enablePan&&this._handleTouchMovePan(t)}_handleTouchMoveDollyRotate(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enableRotate&&this._handleTouchMoveRotate(t)}_addPointer(t){this._pointers.push(t.pointerId)}_removePointer(t){delete this._pointerPositions[t.pointerId];for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId){this._pointers.splice(e,1);return}}_isTrackingPointer(t){for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId)return!0;return!1}_trackPointer(t){let e=this._pointerPositions[t.pointerId];e===void 0&&(e=new Ct,this._pointerPositions[t.pointerId]=e),e.set(t.pageX,t.pageY)}_getSecondPointerPosition(t){let e=t.pointerId===this._pointers[0]?this._pointers[1]:this._pointers[0];return this._pointerPositions[e]}_customWheelEvent(t){let e=t.deltaMode,i={clientX:t.clientX,clientY:t.clientY,deltaY:t.deltaY};switch(e){case 1:i.deltaY*=16;break;case 2:i.deltaY*=100;break}return t.ctrlKey&&!this._controlActive&&(i.deltaY*=10),i}};function eE(n){this.enabled!==!1&&(this._pointers.length===0&&(this.domElement.setPointerCapture(n.pointerId),this.domElement.ownerDocument.addEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.addEventListener("pointerup",this._onPointerUp)),!this._isTrackingPointer(n)&&(this._addPointer(n),n.pointerType==="touch"?this._onTouchStart(n):this._onMouseDown(n),this._cursorStyle==="grab"&&(this.domElement.style.cursor="grabbing")))}function nE(n){this.enabled!==!1&&(n.pointerType==="touch"?this._onTouchMove(n):this._onMouseMove(n))}function iE(n){switch(this._removePointer(n),this._pointers.length){case 0:this.domElement.releasePointerCapture(n.pointerId),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.dispatchEvent(C0),this.state=Qt.NONE,this._cursorStyle==="grab"&&(this.domElement.style.cursor="grab");break;case 1:let t=this._pointers[0],e=this._pointerPositions[t];this._onTouchStart({pointerId:t,pageX:e.x,pageY:e.y});break}}function sE(n){let t;switch(n.button){case 0:t=this.mouseButtons.LEFT;break;case 1:t=this.mouseButtons.MIDDLE;break;case 2:t=this.mouseButtons.RIGHT;break;default:t=-1}switch(t){case Wi.DOLLY:if(this.enableZoom===!1)return;this._handleMouseDownDolly(n),this.state=Qt.DOLLY;break;case Wi.ROTATE:if(n.ctrlKey||n.metaKey||n.shiftKey){if(this.enablePan===!1)return;this._handleMouseDownPan(n),this.state=Qt.PAN}else{if(this.enableRotate===!1)return;this._handleMouseDownRotate(n),this.state=Qt.ROTATE}break;case Wi.PAN:if(n.ctrlKey||n.metaKey||n.shiftKey){if(this.enableRotate===!1)return;this._handleMouseDownRotate(n),this.state=Qt.ROTATE}else{if(this.enablePan===!1)return;this._handleMouseDownPan(n),this.state=Qt.PAN}break;default:this.state=Qt.NONE}this.state!==Qt.NONE&&this.dispatchEvent(If)}function rE(n){switch(this.state){case Qt.ROTATE:if(this.enableRotate===!1)return;this._handleMouseMoveRotate(n);break;case Qt.DOLLY:if(this.enableZoom===!1)return;this._handleMouseMoveDolly(n);break;case Qt.PAN:if(this.enablePan===!1)return;this._handleMouseMovePan(n);break}}function oE(n){this.enabled===!1||this.enableZoom===!1||this.state!==Qt.NONE||(n.preventDefault(),this.dispatchEvent(If),this._handleMouseWheel(this._customWheelEvent(n)),this.dispatchEvent(C0))}function aE(n){this.enabled!==!1&&this._handleKeyDown(n)}function lE(n){switch(this._trackPointer(n),this._pointers.length){case 1:switch(this.touches.ONE){case Xi.ROTATE:if(this.enableRotate===!1){this.state=Qt.NONE;break}this._handleTouchStartRotate(n),this.state=Qt.TOUCH_ROTATE;break;case Xi.PAN:if(this.enablePan===!1){this.state=Qt.NONE;break}this._handleTouchStartPan(n),this.state=Qt.TOUCH_PAN;break;default:this.state=Qt.NONE}break;case 2:switch(this.touches.TWO){case Xi.DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchStartDollyPan(n),this.state=Qt.TOUCH_DOLLY_PAN;break;case Xi.DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchStartDollyRotate(n),this.state=Qt.TOUCH_DOLLY_ROTATE;break;default:this.state=Qt.NONE}break;default:this.state=Qt.NONE}this.state!==Qt.NONE&&this.dispatchEvent(If)}function cE(n){switch(this._trackPointer(n),this.state){case Qt.TOUCH_ROTATE:if(this.enableRotate===!1)return;this._handleTouchMoveRotate(n),this.update();break;case Qt.TOUCH_PAN:if(this.enablePan===!1)return;this._handleTouchMovePan(n),this.update();break;case Qt.TOUCH_DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchMoveDollyPan(n),this.update();break;case Qt.TOUCH_DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchMoveDollyRotate(n),this.update();break;default:this.state=Qt.NONE}}function hE(n){this.enabled!==!1&&n.preventDefault()}function uE(n){n.key==="Control"&&(this._controlActive=!0,this.domElement.ownerDocument.addEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}function fE(n){n.key==="Control"&&(this._controlActive=!1,this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}_t.line={worldUnits:{value:1},linewidth:{value:1},resolution:{value:new Ct},dashOffset:{value:0},dashScale:{value:1},dashSize:{value:1},gapSize:{value:1}};en.line={uniforms:Xo.merge([_t.common,_t.fog,_t.line]),vertexShader:`
		#include <common>
		#include <color_pars_vertex>
		#include <fog_pars_vertex>
		#include <logdepthbuf_pars_vertex>
		#include <clipping_planes_pars_vertex>

		uniform float linewidth;
		uniform vec2 resolution;

		attribute vec3 instanceStart;
		attribute vec3 instanceEnd;

		attribute vec3 instanceColorStart;
		attribute vec3 instanceColorEnd;

		#ifdef WORLD_UNITS

			varying vec4 worldPos;
			varying vec3 worldStart;
			varying vec3 worldEnd;

			#ifdef USE_DASH

				varying vec2 vUv;

			#endif

		#else

			varying vec2 vUv;

		#endif

		#ifdef USE_DASH

			uniform float dashScale;
			attribute float instanceDistanceStart;
			attribute float instanceDistanceEnd;
			varying float vLineDistance;

		#endif

		float trimSegmentAlpha( const in vec4 start, const in vec4 end ) {

			// compute the interpolation factor needed to trim the segment so it terminates
			// between the camera plane and the near plane

			// conservative estimate of the near plane
			float a = projectionMatrix[ 2 ][ 2 ]; // 3nd entry in 3th column
			float b = projectionMatrix[ 3 ][ 2 ]; // 3nd entry in 4th column

			// we need different nearEstimate formula for reversed and default depth buffer
			// a is positive with a reversed depth buffer so it can be used for controlling the code flow
			float nearEstimate = ( a > 0.0 ) ? ( - b / ( a + 1.0 ) ) : ( - 0.5 * b / a );

			return ( nearEstimate - start.z ) / ( end.z - start.z );

		}

		void main() {

			#ifdef USE_COLOR

				vColor.xyz = ( position.y < 0.5 ) ? instanceColorStart : instanceColorEnd;

			#endif

			float aspect = resolution.x / resolution.y;

			// camera space
			vec4 start = modelViewMatrix * vec4( instanceStart, 1.0 );
			vec4 end = modelViewMatrix * vec4( instanceEnd, 1.0 );

			#ifdef USE_DASH

				float lineDistanceStart = dashScale * instanceDistanceStart;
				float lineDistanceEnd = dashScale * instanceDistanceEnd;

			#endif

			#ifdef WORLD_UNITS

				worldStart = start.xyz;
				worldEnd = end.xyz;

			#else

				vUv = uv;

			#endif

			// special case for perspective projection, and segments that terminate either in, or behind, the camera plane
			// clearly the gpu firmware has a way of addressing this issue when projecting into ndc space
			// but we need to perform ndc-space calculations in the shader, so we must address this issue directly
			// perhaps there is a more elegant solution -- WestLangley

			bool perspective = ( projectionMatrix[ 2 ][ 3 ] == - 1.0 ); // 4th entry in the 3rd column

			if ( perspective ) {

				if ( start.z < 0.0 && end.z >= 0.0 ) {

					float alpha = trimSegmentAlpha( start, end );
					end.xyz = mix( start.xyz, end.xyz, alpha );

					#ifdef USE_DASH

						lineDistanceEnd = mix( lineDistanceStart, lineDistanceEnd, alpha );

					#endif

				} else if ( end.z < 0.0 && start.z >= 0.0 ) {

					float alpha = trimSegmentAlpha( end, start );
					start.xyz = mix( end.xyz, start.xyz, alpha );

					#ifdef USE_DASH

						lineDistanceStart = mix( lineDistanceEnd, lineDistanceStart, alpha );

					#endif

				}

			}

			#ifdef USE_DASH

				vLineDistance = ( position.y < 0.5 ) ? lineDistanceStart : lineDistanceEnd;
				vUv = uv;

			#endif

			// clip space
			vec4 clipStart = projectionMatrix * start;
			vec4 clipEnd = projectionMatrix * end;

			// ndc space
			vec3 ndcStart = clipStart.xyz / clipStart.w;
			vec3 ndcEnd = clipEnd.xyz / clipEnd.w;

			// direction
			vec2 dir = ndcEnd.xy - ndcStart.xy;

			// account for clip-space aspect ratio
			dir.x *= aspect;
			dir = normalize( dir );

			#ifdef WORLD_UNITS

				vec3 worldDir = normalize( end.xyz - start.xyz );
				vec3 tmpFwd = perspective ? normalize( mix( start.xyz, end.xyz, 0.5 ) ) : vec3( 0.0, 0.0, - 1.0 );
				vec3 worldUp = normalize( cross( worldDir, tmpFwd ) );
				vec3 worldFwd = cross( worldDir, worldUp );
				worldPos = position.y < 0.5 ? start: end;

				// height offset
				float hw = linewidth * 0.5;
				worldPos.xyz += position.x < 0.0 ? hw * worldUp : - hw * worldUp;

				// don't extend the line if we're rendering dashes because we
				// won't be rendering the endcaps
				#ifndef USE_DASH

					// cap extension
					worldPos.xyz += position.y < 0.5 ? - hw * worldDir : hw * worldDir;

					// add width to the box
					worldPos.xyz += worldFwd * hw;

					// endcaps
					if ( position.y > 1.0 || position.y < 0.0 ) {

						worldPos.xyz -= worldFwd * 2.0 * hw;

					}

				#endif

				// project the worldpos
				vec4 clip = projectionMatrix * worldPos;

				// shift the depth of the projected points so the line
				// segments overlap neatly
				vec3 clipPose = ( position.y < 0.5 ) ? ndcStart : ndcEnd;

				// only shift the depth of vertices in front of the camera (#35137)
				if ( clip.w > 0.0 ) clip.z = clipPose.z * clip.w;

			#else

				vec2 offset = vec2( dir.y, - dir.x );
				// undo aspect ratio adjustment
				dir.x /= aspect;
				offset.x /= aspect;

				// sign flip
				if ( position.x < 0.0 ) offset *= - 1.0;

				// endcaps
				if ( position.y < 0.0 ) {

					offset += - dir;

				} else if ( position.y > 1.0 ) {

					offset += dir;

				}

				// adjust for linewidth
				offset *= linewidth;

				// adjust for clip-space to screen-space conversion // maybe resolution should be based on viewport ...
				offset /= resolution.y;

				// select end
				vec4 clip = ( position.y < 0.5 ) ? clipStart : clipEnd;

				// back to clip space
				offset *= clip.w;

				clip.xy += offset;

			#endif

			gl_Position = clip;

			vec4 mvPosition = ( position.y < 0.5 ) ? start : end; // this is an approximation

			#include <logdepthbuf_vertex>
			#include <clipping_planes_vertex>
			#include <fog_vertex>

		}
		`,fragmentShader:`
		uniform vec3 diffuse;
		uniform float opacity;
		uniform float linewidth;

		#ifdef USE_DASH

			uniform float dashOffset;
			uniform float dashSize;
			uniform float gapSize;

		#endif

		varying float vLineDistance;

		#ifdef WORLD_UNITS

			varying vec4 worldPos;
			varying vec3 worldStart;
			varying vec3 worldEnd;

			#ifdef USE_DASH

				varying vec2 vUv;

			#endif

		#else

			varying vec2 vUv;

		#endif

		#include <common>
		#include <color_pars_fragment>
		#include <fog_pars_fragment>
		#include <logdepthbuf_pars_fragment>
		#include <clipping_planes_pars_fragment>

		vec2 closestLineToLine(vec3 p1, vec3 p2, vec3 p3, vec3 p4) {

			float mua;
			float mub;

			vec3 p13 = p1 - p3;
			vec3 p43 = p4 - p3;

			vec3 p21 = p2 - p1;

			float d1343 = dot( p13, p43 );
			float d4321 = dot( p43, p21 );
			float d1321 = dot( p13, p21 );
			float d4343 = dot( p43, p43 );
			float d2121 = dot( p21, p21 );

			float denom = d2121 * d4343 - d4321 * d4321;

			float numer = d1343 * d4321 - d1321 * d4343;

			mua = numer / denom;
			mua = clamp( mua, 0.0, 1.0 );
			mub = ( d1343 + d4321 * ( mua ) ) / d4343;
			mub = clamp( mub, 0.0, 1.0 );

			return vec2( mua, mub );

		}

		void main() {

			float alpha = opacity;
			vec4 diffuseColor = vec4( diffuse, alpha );

			#include <clipping_planes_fragment>

			#ifdef USE_DASH

				if ( vUv.y < - 1.0 || vUv.y > 1.0 ) discard; // discard endcaps

				if ( mod( vLineDistance + dashOffset, dashSize + gapSize ) > dashSize ) discard; // todo - FIX

			#endif

			#ifdef WORLD_UNITS

				float len;

				if ( isOrthographic ) {

					// View rays are parallel to the z axis so the distance reduces to camera-space XY
					vec2 lineDir = worldEnd.xy - worldStart.xy;
					float t = clamp( dot( worldPos.xy - worldStart.xy, lineDir ) / dot( lineDir, lineDir ), 0.0, 1.0 );
					len = length( worldStart.xy + lineDir * t - worldPos.xy );

				} else {

					// Find the closest points on the view ray and the line segment
					vec3 rayEnd = normalize( worldPos.xyz ) * 1e5;
					vec3 lineDir = worldEnd - worldStart;
					vec2 params = closestLineToLine( worldStart, worldEnd, vec3( 0.0, 0.0, 0.0 ), rayEnd );

					vec3 p1 = worldStart + lineDir * params.x;
					vec3 p2 = rayEnd * params.y;
					vec3 delta = p1 - p2;
					len = length( delta );

				}

				float norm = len / linewidth;

				#ifndef USE_DASH

					#ifdef USE_ALPHA_TO_COVERAGE

						float dnorm = fwidth( norm );
						alpha = 1.0 - smoothstep( 0.5 - dnorm, 0.5 + dnorm, norm );

					#else

						if ( norm > 0.5 ) {

							discard;

						}

					#endif

				#endif

			#else

				#ifdef USE_ALPHA_TO_COVERAGE

					// artifacts appear on some hardware if a derivative is taken within a conditional
					float a = vUv.x;
					float b = ( vUv.y > 0.0 ) ? vUv.y - 1.0 : vUv.y + 1.0;
					float len2 = a * a + b * b;
					float dlen = fwidth( len2 );

					if ( abs( vUv.y ) > 1.0 ) {

						alpha = 1.0 - smoothstep( 1.0 - dlen, 1.0 + dlen, len2 );

					}

				#else

					if ( abs( vUv.y ) > 1.0 ) {

						float a = vUv.x;
						float b = ( vUv.y > 0.0 ) ? vUv.y - 1.0 : vUv.y + 1.0;
						float len2 = a * a + b * b;

						if ( len2 > 1.0 ) discard;

					}

				#endif

			#endif

			#include <logdepthbuf_fragment>
			#include <color_fragment>

			gl_FragColor = vec4( diffuseColor.rgb, alpha );

			#include <tonemapping_fragment>
			#include <colorspace_fragment>
			#include <fog_fragment>
			#include <premultiplied_alpha_fragment>

		}
		`};var Dr=class extends Mn{constructor(t){super({type:"LineMaterial",uniforms:Xo.clone(en.line.uniforms),vertexShader:en.line.vertexShader,fragmentShader:en.line.fragmentShader,clipping:!0}),this.isLineMaterial=!0,this.setValues(t)}get color(){return this.uniforms.diffuse.value}set color(t){this.uniforms.diffuse.value=t}get worldUnits(){return"WORLD_UNITS"in this.defines}set worldUnits(t){t===!0!==this.worldUnits&&(this.needsUpdate=!0),t===!0?this.defines.WORLD_UNITS="":delete this.defines.WORLD_UNITS}get linewidth(){return this.uniforms.linewidth.value}set linewidth(t){this.uniforms.linewidth&&(this.uniforms.linewidth.value=t)}get dashed(){return"USE_DASH"in this.defines}set dashed(t){t===!0!==this.dashed&&(this.needsUpdate=!0),t===!0?this.defines.USE_DASH="":delete this.defines.USE_DASH}get dashScale(){return this.uniforms.dashScale.value}set dashScale(t){this.uniforms.dashScale.value=t}get dashSize(){return this.uniforms.dashSize.value}set dashSize(t){this.uniforms.dashSize.value=t}get dashOffset(){return this.uniforms.dashOffset.value}set dashOffset(t){this.uniforms.dashOffset.value=t}get gapSize(){return this.uniforms.gapSize.value}set gapSize(t){this.uniforms.gapSize.value=t}get opacity(){return this.uniforms.opacity.value}set opacity(t){this.uniforms&&(this.uniforms.opacity.value=t)}get resolution(){return this.uniforms.resolution.value}set resolution(t){this.uniforms.resolution.value.copy(t)}get alphaToCoverage(){return"USE_ALPHA_TO_COVERAGE"in this.defines}set alphaToCoverage(t){this.defines&&(t===!0!==this.alphaToCoverage&&(this.needsUpdate=!0),t===!0?this.defines.USE_ALPHA_TO_COVERAGE="":delete this.defines.USE_ALPHA_TO_COVERAGE)}};var R0=new dn,Zc=new N,As=class extends Lo{constructor(){super(),this.isLineSegmentsGeometry=!0,this.type="LineSegmentsGeometry";let t=[-1,2,0,1,2,0,-1,1,0,1,1,0,-1,0,0,1,0,0,-1,-1,0,1,-1,0],e=[-1,2,1,2,-1,1,1,1,-1,-1,1,-1,-1,-2,1,-2],i=[0,2,1,2,3,1,2,4,3,4,5,3,4,6,5,6,7,5];this.setIndex(i),this.setAttribute("position",new Ht(t,3)),this.setAttribute("uv",new Ht(e,2))}applyMatrix4(t){let e=this.attributes.instanceStart,i=this.attributes.instanceEnd;return e!==void 0&&(e.applyMatrix4(t),i.applyMatrix4(t),e.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this}setPositions(t){let e;t instanceof Float32Array?e=t:Array.isArray(t)&&(e=new Float32Array(t));let i=new Hi(e,6,1);return this.setAttribute("instanceStart",new Un(i,3,0)),this.setAttribute("instanceEnd",new Un(i,3,3)),this.instanceCount=this.attributes.instanceStart.count,this.computeBoundingBox(),this.computeBoundingSphere(),this}setColors(t){let e;t instanceof Float32Array?e=t:Array.isArray(t)&&(e=new Float32Array(t));let i=new Hi(e,6,1);return this.setAttribute("instanceColorStart",new Un(i,3,0)),this.setAttribute("instanceColorEnd",new Un(i,3,3)),this}fromWireframeGeometry(t){return this.setPositions(t.attributes.position.array),this}fromEdgesGeometry(t){return this.setPositions(t.attributes.position.array),this}fromMesh(t){return this.fromWireframeGeometry(new Eo(t.geometry)),this}fromLineSegments(t){let e=t.geometry;return this.setPositions(e.attributes.position.array),this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new dn);let t=this.attributes.instanceStart,e=this.attributes.instanceEnd;t!==void 0&&e!==void 0&&(this.boundingBox.setFromBufferAttribute(t),R0.setFromBufferAttribute(e),this.boundingBox.union(R0))}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new Dn),this.boundingBox===null&&this.computeBoundingBox();let t=this.attributes.instanceStart,e=this.attributes.instanceEnd;if(t!==void 0&&e!==void 0){let i=this.boundingSphere.center;this.boundingBox.getCenter(i);let s=0;for(let r=0,o=t.count;r<o;r++)Zc.fromBufferAttribute(t,r),s=Math.max(s,i.distanceToSquared(Zc)),Zc.fromBufferAttribute(e,r),s=Math.max(s,i.distanceToSquared(Zc));this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&console.error("THREE.LineSegmentsGeometry.computeBoundingSphere(): Computed radius is NaN. The instanced position data is likely to have NaN values.",this)}}toJSON(){}};var Lf=new ee,P0=new N,I0=new N,Ue=new ee,Oe=new ee,jn=new ee,Nf=new N,Df=new se,Fe=new Do,L0=new N,Jc=new dn,Kc=new Dn,Qn=new ee,ti,Ts;function N0(n,t,e){return Qn.set(0,0,-t,1).applyMatrix4(n.projectionMatrix),Qn.multiplyScalar(1/Qn.w),Qn.x=Ts/e.width,Qn.y=Ts/e.height,Qn.applyMatrix4(n.projectionMatrixInverse),Qn.multiplyScalar(1/Qn.w),Math.abs(Math.max(Qn.x,Qn.y))}function dE(n,t){let e=n.matrixWorld,i=n.geometry,s=i.attributes.instanceStart,r=i.attributes.instanceEnd,o=Math.min(i.instanceCount,s.count);for(let a=0,c=o;a<c;a++){Fe.start.fromBufferAttribute(s,a),Fe.end.fromBufferAttribute(r,a),Fe.applyMatrix4(e);let l=new N,h=new N;ti.distanceSqToSegment(Fe.start,Fe.end,h,l),h.distanceTo(l)<Ts*.5&&t.push({point:h,pointOnLine:l,distance:ti.origin.distanceTo(h),object:n,face:null,faceIndex:a,uv:null,uv1:null})}}function pE(n,t,e){let i=t.projectionMatrix,r=n.material.resolution,o=n.matrixWorld,a=n.geometry,c=a.attributes.instanceStart,l=a.attributes.instanceEnd,h=Math.min(a.instanceCount,c.count),u=-t.near;ti.at(1,jn),jn.w=1,jn.applyMatrix4(t.matrixWorldInverse),jn.applyMatrix4(i),jn.multiplyScalar(1/jn.w),jn.x*=r.x/2,jn.y*=r.y/2,jn.z=0,Nf.copy(jn),Df.multiplyMatrices(t.matrixWorldInverse,o);for(let f=0,d=h;f<d;f++){if(Ue.fromBufferAttribute(c,f),Oe.fromBufferAttribute(l,f),Ue.w=1,Oe.w=1,Ue.applyMatrix4(Df),Oe.applyMatrix4(Df),Ue.z>u&&Oe.z>u)continue;if(Ue.z>u){let b=Ue.z-Oe.z,v=(Ue.z-u)/b;Ue.lerp(Oe,v)}else if(Oe.z>u){let b=Oe.z-Ue.z,v=(Oe.z-u)/b;Oe.lerp(Ue,v)}Ue.applyMatrix4(i),Oe.applyMatrix4(i),Ue.multiplyScalar(1/Ue.w),Oe.multiplyScalar(1/Oe.w),Ue.x*=r.x/2,Ue.y*=r.y/2,Oe.x*=r.x/2,Oe.y*=r.y/2,Fe.start.copy(Ue),Fe.start.z=0,Fe.end.copy(Oe),Fe.end.z=0;let _=Fe.closestPointToPointParameter(Nf,!0);Fe.at(_,L0);let m=Wo.lerp(Ue.z,Oe.z,_),p=m>=-1&&m<=1,y=Nf.distanceTo(L0)<Ts*.5;if(p&&y){Fe.start.fromBufferAttribute(c,f),Fe.end.fromBufferAttribute(l,f),Fe.start.applyMatrix4(o),Fe.end.applyMatrix4(o);let b=new N,v=new N;ti.distanceSqToSegment(Fe.start,Fe.end,v,b),e.push({point:v,pointOnLine:b,distance:ti.origin.distanceTo(v),object:n,face:null,faceIndex:f,uv:null,uv1:null})}}}var Ur=class extends _e{constructor(t=new As,e=new Dr({color:Math.random()*16777215})){super(t,e),this.isLineSegments2=!0,this.type="LineSegments2"}computeLineDistances(){let t=this.geometry,e=t.attributes.instanceStart,i=t.attributes.instanceEnd,s=new Float32Array(2*e.count);for(let o=0,a=0,c=e.count;o<c;o++,a+=2)P0.fromBufferAttribute(e,o),I0.fromBufferAttribute(i,o),s[a]=a===0?0:s[a-1],s[a+1]=s[a]+P0.distanceTo(I0);let r=new Hi(s,2,1);return t.setAttribute("instanceDistanceStart",new Un(r,1,0)),t.setAttribute("instanceDistanceEnd",new Un(r,1,1)),this}raycast(t,e){let i=this.material.worldUnits,s=t.camera;if(s===null&&!i&&console.error('LineSegments2: "Raycaster.camera" needs to be set in order to raycast against LineSegments2 while worldUnits is set to false.'),i===!1&&(this.material.resolution.x===0||this.material.resolution.y===0))return;let r=t.params.Line2!==void 0&&t.params.Line2.threshold||0;ti=t.ray;let o=this.matrixWorld,a=this.geometry,c=this.material;Ts=c.linewidth+r,a.boundingSphere===null&&a.computeBoundingSphere(),Kc.copy(a.boundingSphere).applyMatrix4(o);let l;if(i)l=Ts*.5;else{let u=Math.max(s.near,Kc.distanceToPoint(ti.origin));l=N0(s,u,c.resolution)}if(Kc.radius+=l,ti.intersectsSphere(Kc)===!1)return;a.boundingBox===null&&a.computeBoundingBox(),Jc.copy(a.boundingBox).applyMatrix4(o);let h;if(i)h=Ts*.5;else{let u=Math.max(s.near,Jc.distanceToPoint(ti.origin));h=N0(s,u,c.resolution)}Jc.expandByScalar(h),ti.intersectsBox(Jc)!==!1&&(i?dE(this,e):pE(this,s,e))}onBeforeRender(t){let e=this.material.uniforms;e&&e.resolution&&(t.getViewport(Lf),this.material.uniforms.resolution.value.set(Lf.z,Lf.w))}};var D0={rolling:null,sliding:[1.5,.9],flight:[.28,.55]};function mE(n){let t=[];for(let e=0;e+1<n.length;e++)t.push(...n[e],...n[e+1]);return t}var jc=class{constructor(){this.group=new Xe,this.lines=new Map,this.pixels={width:1,height:1}}#t(t,e,i,s,r,o,a,c){let l=i==="thread",h=this.lines.get(t);h||(h=l?new bi(new he,new Yn({transparent:!0,depthWrite:!1})):new Ur(new As,new Dr({dashed:D0[i]!==null,transparent:!0,depthWrite:!1})),h.frustumCulled=!1,this.lines.set(t,h),this.group.add(h)),h.geometry.dispose();let u=h.material;if(u.color.set(s),u.opacity=o,h.renderOrder=c?3:2,h.visible=!0,h instanceof Ur){let f=D0[i];h.geometry=new As().setPositions(e),h.material.linewidth=r,h.material.resolution.set(this.pixels.width,this.pixels.height),f&&(h.material.dashSize=f[0]*a,h.material.gapSize=f[1]*a,h.computeLineDistances())}else h.geometry=new he,h.geometry.setAttribute("position",new Ht(e,3))}update(t,e){for(let r of this.lines.values())r.visible=!1;let i=Kn(t.box)/100,s=t.scene.balls.length>6;for(let[r,o]of t.runs){let a=r===t.followed;o.balls.forEach(({pieces:c},l)=>{if(!a&&l!==t.ball)return;let h=l===t.ball,u=(h?t.colours.get(r):null)??e(l),f={rolling:[],sliding:[],flight:[],thread:[]};for(let{style:d,points:g}of Fs(c,t.until,t.scene.balls[l].radius)){if(f[t.scene.floor?d:"rolling"].push(...mE(g)),d!=="flight"||!t.scene.floor||s)continue;let _=t.scene.balls[l].radius;for(let m of g)m[2]>_*1.001&&m[2]<5*_&&f.thread.push(...m,m[0],m[1],0)}for(let[d,g]of Object.entries(f)){if(!g.length)continue;let _=d==="thread"?.35:h?1:s?.45:.75;this.#t(`${r} ${l} ${d}`,g,d,u,h?a?3.4:2.4:1.4,_,i,a)}})}}resize(t,e){this.pixels={width:t,height:e};for(let i of this.lines.values())i instanceof Ur&&i.material.resolution.set(t,e)}};function Of(n,t){let e=new he;return e.setAttribute("position",new Ht(n,3)),e.setIndex(t),e.computeVertexNormals(),e}function gE(n,t,e){let i=[],s=[];for(let r of n)for(let o=0;o+1<r.length;o++){let a=i.length/3;i.push(...r[o],t,...r[o+1],t,...r[o+1],e,...r[o],e),s.push(a,a+1,a+2,a,a+2,a+3)}return Of(i,s)}function U0(n,t){let e=[];for(let s of t)for(let r of n)for(let o=0;o+1<r.length;o++)e.push(...r[o],s,...r[o+1],s);let i=new he;return i.setAttribute("position",new Ht(e,3)),i}function _E(n,t,e){let i=Math.max(...t.balls.map(m=>m.radius)),[,s]=$c(n,t,e),r=n.nose_height??null,o=Math.max(Math.min(s,1.7*i),r===null?0:r+.12*i),a=2.2*i,c=r===null?[[0,0],[0,o],[a,o],[a,0]]:[[.55*i,0],[0,r],[.25*i,o],[a,o],[a,0]],[l,h]=n.center,u=[[-1,-1],[1,-1],[1,1],[-1,1],[-1,-1]].map(([m,p])=>c.map(([y,b])=>[l+m*(n.length/2+y),h+p*(n.width/2+y),b])),f=[],d=[];for(let m=0;m<4;m++)for(let p=0;p+1<c.length;p++){let y=f.length/3;f.push(...u[m][p],...u[m+1][p],...u[m+1][p+1],...u[m][p+1]),d.push(y,y+1,y+2,y,y+2,y+3)}let g=1,_=u.map(m=>[m[g][0],m[g][1]]);return{faces:Of(f,d),lines:U0([_],[c[g][1]])}}function Uf(n,t,e,i,s){let r=Kn(i),o=Math.hypot(t[0],t[1]),a=Nr(i),c=(n[0]-a[0])*t[0]+(n[1]-a[1])*t[1]+(n[2]-a[2])*t[2],l=En(a,sn(t,c));if(o<.05){let w=.62*r,D=l[2],R=-Math.sign(t[2])*.02*r;return new Si(2*w,2*w,Math.abs(R)).translate(a[0],a[1],D+R/2)}let h=Ge([-t[1],t[0],0]),u=_a(t,h),f=u[2]<0?sn(u,-1):u,[d,g]=$c({},e,i),_=w=>En(l,sn(f,(w-l[2])/f[2])),m=.75*r,p=sn(Ge([t[0],t[1],0]),-.05*r),[y,b]=[_(d),_(g)],v=[En(y,sn(h,-m)),En(y,sn(h,m)),En(b,sn(h,m)),En(b,sn(h,-m))],A=v.map(w=>En(w,p)),E=s?[0,1,2,0,2,3,3,2,6,3,6,7,0,4,5,0,5,1,1,5,6,1,6,2,0,3,7,0,7,4]:[0,1,2,0,2,3],x=Of([...v,...A].flat(),E).toNonIndexed();return x.computeVertexNormals(),x}function xE(n,t,e){let[i,s]=$c(n,t,e);switch(n.shape){case"table":return[_E(n,t,e)];case"plane":{let r=Ge(n.normal);return[{faces:Uf(n.point,r,t,e,!0),clear:Math.hypot(r[0],r[1])<.05}]}case"strip":{let r=Ge(n.normal),o=En(n.point,sn(r,n.width)),a=Math.hypot(r[0],r[1])<.05;return[{faces:Uf(n.point,r,t,e,!0),clear:a},{faces:Uf(o,sn(r,-1),t,e,!0),clear:a}]}case"box":{let[r,o]=Rf(n),a=sn(En(r,o),.5);return[{faces:new Si(...n.size).translate(...a),inside:n.inside}]}case"sphere":return[{faces:new ys(n.radius,48,24).rotateX(Math.PI/2).translate(...n.center),inside:n.inside,lines:new he}];case"cylinder":{let r=Ge(n.axis),o=ns(n.length),a=Math.abs(r[2])>.99,c=Number.isFinite(o)?o:a?s-i:2*Kn(e),l=new ki(n.radius,n.radius,c,64,1,n.inside);l.applyQuaternion(new Ne().setFromUnitVectors(new N(0,1,0),new N(...r)));let h=Number.isFinite(o)||a?0:-c/2,u=Number.isFinite(o)||!a?n.point:[n.point[0],n.point[1],r[2]>0?i:s];return[{faces:l.translate(...En(u,sn(r,h+c/2))),inside:n.inside}]}default:{let r=Ko(n,e);return[{faces:gE(r,i,s),lines:U0(r,[i,s]),clear:!0}]}}}function O0(n,t,e){let i=new Xe,s=new Yn({color:e.edge});for(let r of n.walls)for(let{faces:o,lines:a,inside:c,clear:l}of xE(r,n,t)){let h=!!(l||c),u=new vs({color:e.wall,side:c?De:Sn,transparent:h,opacity:h?.3:1,depthWrite:!h,polygonOffset:!0,polygonOffsetFactor:1,polygonOffsetUnits:1});i.add(new _e(o,u)),i.add(new bi(a??new wo(o,25),s))}return i}function F0(n){n.traverse(t=>{t.geometry?.dispose();for(let e of[t.material].flat())e?.dispose()})}var B0=26,k0=1.8;function z0(n){let t=10**Math.floor(Math.log10(n)),e=n/t;return(e>=5?5:e>=2?2:1)*t}function yE(){let n=document.createElement("canvas").getContext("webgl2"),t=n?.getExtension("WEBGL_debug_renderer_info"),e=n&&t?String(n.getParameter(t.UNMASKED_RENDERER_WEBGL)):"";return n?.getExtension("WEBGL_lose_context")?.loseContext(),/swiftshader|llvmpipe|software|basic render/i.test(e)}function V0(n,t,e){let i=new Gc({antialias:!yE(),alpha:!1,powerPreference:"low-power"}),s=i.domElement;s.tabIndex=0,s.setAttribute("role","img"),n.prepend(s);let r=new go,o=new je(30,1,.01,100);o.up.set(0,0,1);let a=new Po("#ffffff",2.3);a.position.set(.5,-1,2.1);let c=new Io("#ffffff",1.35);r.add(a,c);let l=null,h=0,u=!1,f=new N,d={groups:[],of:""},g=new Map,_=[],m=new jc,p=ME();r.add(p.group,m.group);let y={width:1,height:1},b=new No,v=null,A=[0,0],E=O=>{let Z=s.getBoundingClientRect();return new Ct(O.clientX-Z.left,O.clientY-Z.top)},x=O=>{let Z=O.clone().project(o);return new Ct((Z.x+1)/2*y.width,(1-Z.y)/2*y.height)},w=O=>{if(!l)return null;let Z=l.scene.balls[l.ball].position[2];return b.setFromCamera(new Ct(O.x/y.width*2-1,1-O.y/y.height*2),o),Math.abs(b.ray.direction.z)<.03?null:b.ray.intersectPlane(new Ke(new N(0,0,1),-Z),new N)},D=O=>{if(!l||!p.group.visible)return null;let Z=l.scene.balls[l.ball],B=new N(...Z.position),et=new N(1,0,0).applyQuaternion(o.quaternion).multiplyScalar(Z.radius),it=Math.max(x(B).distanceTo(x(B.clone().add(et))),B0*.7);return x(p.tip).distanceTo(O)<B0?"velocity":x(B).distanceTo(O)<it?"ball":null};s.addEventListener("pointerdown",O=>{if(O.button!==0||!O.isPrimary||!l)return;let Z=E(O),B=D(Z),et=B&&w(Z);if(!B||!et)return;v=B,L.enabled=!1,s.setPointerCapture(O.pointerId);let it=B==="ball"?l.scene.balls[l.ball].position:p.tip.toArray();A=[it[0]-et.x,it[1]-et.y],t.start()}),s.addEventListener("pointermove",O=>{let Z=E(O);if(!v){O.buttons===0&&(s.style.cursor=D(Z)?"grab":"");return}let B=w(Z);if(!B||!l)return;s.style.cursor="grabbing";let[et,it]=[B.x+A[0],B.y+A[1]];if(v==="ball")t.ball(et,it);else{let{position:ot,radius:rt}=l.scene.balls[l.ball],Mt=Math.hypot(et-ot[0],it-ot[1]),Wt=Math.max(0,Mt-k0*rt)/p.time;t.velocity(Wt*(et-ot[0])/(Mt||1),Wt*(it-ot[1])/(Mt||1))}});let R=()=>{v&&(v=null,L.enabled=!0,s.style.cursor="",p.time=l?Lr(l):1,I(),t.end(),H())};s.addEventListener("pointerup",R),s.addEventListener("pointercancel",R);let L=new Yc(o,s);L.zoomSpeed=.8,L.maxPolarAngle=Math.PI*.499,L.addEventListener("change",()=>H());function I(){if(!l)return;let{position:O,velocity:Z,radius:B}=l.scene.balls[l.ball],et=Math.hypot(Z[0],Z[1]),it=et>0?[Z[0]/et,Z[1]/et]:[1,0];p.place(O,it,k0*B+et*p.time,B,Kn(l.box))}function z(O,Z){let B=!l||l.box!==O.box;l=O,r.background=new zt(Z.background);let et=JSON.stringify([O.scene.walls,!!O.scene.floor,O.box,Z,O.scene.balls.map(({radius:it})=>it)]);if(et!==d.of){let it=[bE(O,Z),O0(O.scene,O.box,Z)];r.add(...it);for(let ot of d.groups)r.remove(ot),F0(ot);d={groups:it,of:et}}m.update(O,it=>Ir(O.scene.balls[it],it));for(let{mesh:it}of _)r.remove(it.group);_=[];for(let[it,ot]of O.runs){let rt=it===O.followed;ot.balls.forEach(({pieces:Mt},Wt)=>{if(!rt&&Wt!==O.ball)return;let At=O.colours.get(it)??Z.ink,Dt=Wt===O.ball,Xt=rt?Ir(O.scene.balls[Wt],Wt):At,Pt=rt?Dt?At:"#2b2f36":Z.dark?"#15181d":"#ffffff",ue={ghost:!rt,halo:Dt?At:null,floor:!!O.scene.floor,dark:Z.dark},ae=JSON.stringify([it,Wt,Xt,Pt,ue]),ve=g.get(ae)??new Xc(Xt,Pt,ue);g.set(ae,ve),ve.resize(O.scene.balls[Wt].radius),r.add(ve.group),_.push({mesh:ve,turns:new Os(Mt),law:it,ball:Wt})})}p.colour(Z.ink),v||(p.time=Lr(O)),I(),B&&j("free"),C(h)}function C(O){h=O,H()}function H(){u||(u=!0,requestAnimationFrame(q))}function q(){if(u=!1,!l)return;let O=l.runs.get(l.followed),Z=O?ai(O.balls[l.ball].pieces,h).x:null;for(let{mesh:et,turns:it,law:ot}of _){let{x:rt}=ai(it.pieces,h),Mt=ot===l.followed||!Z?1/0:Math.hypot(rt[0]-Z[0],rt[1]-Z[1],rt[2]-Z[2]);et.place(rt,it.at(h),Mt)}p.group.visible=Math.abs(o.getWorldDirection(f).z)>.12,i.render(r,o),V(Z);let B=[new N(...l.scene.balls[l.ball].position),p.tip].map(et=>x(et).toArray().map(Math.round).join());[s.dataset.ball,s.dataset.arrow]=B}function V(O){if(!l)return;let Z=o.position.distanceTo(L.target),B=y.height/(2*Z*Math.tan(o.fov*Math.PI/360)),et=z0(110/B),it=`${(et*B).toFixed(1)}px`;e.scale.style.width!==it&&(e.scale.style.width=it,e.scale.textContent=et>=1?`${et} m`:`${Number((et*1e3).toPrecision(1))} mm`);let ot=O&&l.scene.floor?O[2]-l.scene.balls[l.ball].radius:0;if(e.height.hidden=!(O&&ot>2e-5),O&&ot>2e-5){let rt=x(new N(O[0],O[1],O[2]+l.scene.balls[l.ball].radius));e.height.textContent=`${ot<.1?`${(ot*1e3).toPrecision(2)} mm`:`${ot.toPrecision(3)} m`} up`,e.height.style.transform=`translate(${rt.x.toFixed(1)}px, ${(rt.y-26).toFixed(1)}px) translateX(-50%)`}}function j(O){if(!l)return;let{low:Z,high:B}=l.box,et=new N(...Nr(l.box)),it=l.scene.walls.find(Pt=>Pt.shape==="plane"&&Math.hypot(Pt.normal[0],Pt.normal[1])>.3),ot=l.runs.get(l.followed)?.events.find(Pt=>Pt.kind==="wall"&&Pt.ball===l?.ball),rt=it?Ge([it.normal[0],it.normal[1],0]):O==="along"&&ot?vE(ot.impulse):[0,-1,0],Mt=new N(rt[0],rt[1],0),Wt=new N(-rt[1],rt[0],0),At=[];for(let Pt of[Z[0],B[0]])for(let ue of[Z[1],B[1]])for(let ae of[Z[2],B[2]])At.push(new N(Pt,ue,ae));let Dt=new N;if(O==="along"){Dt.copy(Wt).multiplyScalar(-1).setZ(.05);let Pt=l.scene.balls[l.ball].radius;ot&&l.scene.floor&&(et.set(ot.x[0],ot.x[1],1.6*Pt).addScaledVector(Mt,3*Pt),At=[-5,6].flatMap(ue=>[-1.4,2].map(ae=>et.clone().addScaledVector(Mt,ue*Pt).setZ(et.z+ae*Pt))))}else O==="side"?Dt.copy(Mt).setZ(.05):O==="above"?Dt.set(0,-5e-4,1):Dt.copy(Mt).multiplyScalar(it?.8:1).addScaledVector(Wt,it?-.75:.2).setZ(it?.8:1.05);Dt.normalize();let Xt=X(At,et,Dt);o.near=Math.max(Xt/200,1e-4),o.far=Xt*60,o.updateProjectionMatrix(),L.target.copy(et),o.position.copy(et).addScaledVector(Dt,Xt),L.minDistance=Xt/40,L.maxDistance=Xt*8,L.update(),H()}function X(O,Z,B){let et=new N().crossVectors(o.up,B).normalize(),it=new N().crossVectors(B,et),ot=Math.tan(o.fov*Math.PI/360)*.9;return Math.max(...O.map(rt=>{let Mt=rt.clone().sub(Z);return Mt.dot(B)+Math.max(Math.abs(Mt.dot(et))/(ot*o.aspect),Math.abs(Mt.dot(it))/ot)}))}function Y(){let[O,Z]=[n.clientWidth,n.clientHeight];!O||!Z||(i.setPixelRatio(Math.min(devicePixelRatio,2)),i.setSize(O,Z),Object.assign(y,{width:O,height:Z}),o.aspect=O/Z,o.updateProjectionMatrix(),m.resize(s.width,s.height),H())}function st(){return q(),new Promise((O,Z)=>s.toBlob(B=>B?O(B):Z(new Error("The browser gave no picture.")),"image/png"))}return Y(),{update:z,draw:C,look:j,resize:Y,picture:st}}var vE=([n,t])=>Math.abs(n)>Math.abs(t)?[Math.sign(n),0,0]:[0,Math.sign(t)||-1,0];function bE(n,t){let e=new Xe;if(!n.scene.floor)return e;let i=Kn(n.box),[s,r]=Nr(n.box),o=1.6*i,a=new _e(new _s(2*o,2*o),new On({color:t.floor,polygonOffset:!0,polygonOffsetFactor:2,polygonOffsetUnits:2}));a.position.set(s,r,0),e.add(a);let c=z0(i/6),l=[];for(let u=Math.ceil((s-o)/c);u*c<=s+o;u++)l.push(u*c,r-o,0,u*c,r+o,0);for(let u=Math.ceil((r-o)/c);u*c<=r+o;u++)l.push(s-o,u*c,0,s+o,u*c,0);let h=new he;return h.setAttribute("position",new Ht(l,3)),e.add(new bi(h,new Yn({color:t.grid}))),e}function ME(){let n=new On({color:"#000000"}),t=new _e(new ki(1,1,1,12).rotateX(Math.PI/2).translate(0,0,.5),n),e=new _e(new So(1,1,20).rotateX(Math.PI/2).translate(0,0,-.5),n),i=new _e(new xs(.9,1,48),new On({color:"#000000",transparent:!0,opacity:.5,depthWrite:!1})),s=new Xe;s.add(t,e,i);let r=new N,o=new N(0,0,1);return{group:s,tip:r,time:1,colour(a){n.color.set(a),i.material.color.set(a)},place(a,c,l,h,u){let f=Math.max(.07*h,.0022*u),d=new Ne().setFromUnitVectors(o,new N(c[0],c[1],0));r.set(a[0]+c[0]*l,a[1]+c[1]*l,a[2]);let g=Math.min(6*f,.6*l);t.position.set(...a),t.quaternion.copy(d),t.scale.set(f,f,Math.max(l-g,1e-9)),e.position.copy(r),e.quaternion.copy(d),e.scale.set(2.4*f,2.4*f,g),i.position.set(a[0],a[1],a[2]-h*.99),i.scale.setScalar(h)}}}var G0=0;function ei(n,t=!1){let e=Zt("message");e.textContent=n,e.hidden=!n,e.className=t?"good":"bad",clearTimeout(G0),t&&(G0=window.setTimeout(()=>e.hidden=!0,6e3))}function SE(n,t){return t?`#${[1,3,5].map(i=>parseInt(n.slice(i,i+2),16)).map(i=>Math.round(i+(255-i)*.28).toString(16).padStart(2,"0")).join("")}`:n}function wE(){let n=getComputedStyle(document.documentElement),t=e=>n.getPropertyValue(`--${e}`).trim();return{background:t("sky"),floor:t("felt"),grid:t("grid"),wall:t("wall"),edge:t("edge"),ink:t("ink"),soft:t("soft"),dark:document.documentElement.dataset.theme==="dark"}}var H0=n=>JSON.parse(Zt(n).textContent??"null");async function EE(){if(performance.mark("script"),document.documentElement.dataset.theme=matchMedia("(prefers-color-scheme: dark)").matches?"dark":"light",typeof WebAssembly!="object")throw new Error("This browser has no WebAssembly, in which carom's engine is: any browser since 2018 has it.");let n=H0("page-data"),t=Uint8Array.from(atob((Zt("engine-module").textContent??"").trim()),c=>c.charCodeAt(0)),e=await Id(t,H0("engine-layout")),i=e,[s,r]=[e.report.bind(e),e.run.bind(e)],o={run:s,pieces:r,version:e.version,scene:()=>null};Object.assign(window,{carom:o});let a=AE(n,i);o.scene=()=>structuredClone(a.state.scene)}function AE(n,t){let e=new URLSearchParams(location.hash.replace(/^#/,"")).get("preset"),i=Math.max(0,n.presets.findIndex(({name:O})=>O===e)),s=n.presets[i],r=n.cards.map(({name:O})=>O),o=null;try{o=Nh(location.hash,t,r)}catch(O){ei(li(O))}let a=o?.scene??zs(t,s.scene),c=o?.laws??r.filter(O=>s.laws.includes(O)),l=Vs(t,a,c.length?c:[a.run.law]).fault;l!==null&&o&&(ei(`The scene of this link cannot be shown: ${l}`),o=null,a=zs(t,s.scene));let h=new Ga({scene:a,laws:o?.laws??r.filter(O=>s.laws.includes(O)),followed:"",ball:0,wall:-1,t:o?.t??s.time??0,playing:!1,speed:s.slow??1,rebounds:n.rebounds,reboundsFrom:n.reboundsFrom,cards:Lh(n.cards,a)}),{state:u}=h,f=O=>[O,u.cards[0]?.name==="as in the scene"?u.cards[0].name:void 0,u.scene.run.law].find(Z=>Z&&u.laws.includes(Z))??u.laws[0]??"";u.followed=f(o?.followed);let d=Vs(t,u.scene,u.laws),g=Ph(u.scene,d.runs.values()),_=jo(u.scene,d.runs,u.followed,g),m=Ih(u.scene,d.runs.get(u.followed)),p=()=>new Map(u.cards.map(({name:O,colour:Z})=>[O,SE(Z,document.documentElement.dataset.theme==="dark")])),y=Zt("stage"),b={start:()=>h.remember(),ball:(O,Z)=>C(yn(u.scene,u.ball,{position:[O,Z,u.scene.balls[u.ball].position[2]]})),velocity:(O,Z)=>C(yn(u.scene,u.ball,{velocity:[O,Z,u.scene.balls[u.ball].velocity[2]]})),end:()=>{}},v,A=!!document.createElement("canvas").getContext("webgl2");A?v=V0(y,b,{scale:Zt("scale"),height:Zt("height")}):(v=E0(y,b),Zt("scale").hidden=!0,ei("This browser has no WebGL 2: the scene is drawn from above and from the side."));let E=y.querySelector("canvas"),x=y.querySelector(".views");for(let{name:O,label:Z}of A?b0:[])x.append(Jt("button",{type:"button","data-view":O,click:()=>{_=jo(u.scene,d.runs,u.followed,g),V(new Set(["scene"])),v.look(O)}},Z));let w=z(),D=ip(Zt("controls"),h,C,ei),R=xm(Zt("angles")),L=bm(h,()=>({until:g,events:m})),I=ym(Zt("course"),L.seek);cp(h,v,()=>d.runs.get(u.followed),ei);function z(){return Zt("laws").replaceChildren(Jt("h2",{},"Laws")),{cards:u.cards,panel:sp(Zt("laws"),h)}}function C(O){let Z=Vs(t,O,u.laws.length?u.laws:[O.run.law]);if(Z.fault!==null){ei(Z.fault),D.update();return}ei(""),h.change({scene:O},"scene")}let H=new Set,q=!1;h.listen(O=>{(O.has("scene")||O.has("laws"))&&(u.cards=Lh(n.cards,u.scene),u.laws=u.cards.map(({name:Z})=>Z).filter(Z=>u.laws.includes(Z)),u.followed=f(u.followed),d=Vs(t,u.scene,u.laws),g=Ph(u.scene,d.runs.values()),m=Ih(u.scene,d.runs.get(u.followed)),u.t=Math.min(u.t,g)),H=new Set([...H,...O]),q||requestAnimationFrame(()=>V(H)),q=!0});function V(O){q=!1,H=new Set;let Z=p();if(O.has("scene")||O.has("laws")){v.update({scene:u.scene,ball:u.ball,followed:u.followed,runs:d.runs,colours:Z,until:g,box:_},wE()),Zt("key").hidden=!u.scene.floor,E.setAttribute("aria-label",`The scene: ${u.scene.balls.length} ball${u.scene.balls.length>1?"s":""} under ${u.laws.join(", ")||"no law"}. Drag the ball or its arrow, or use the sliders.`);let{verdicts:B,none:et}=Rh(t,u.scene);w.cards.length!==u.cards.length&&Object.assign(w,z()),w.panel.update(B,Z,d.notes,et),D.update(),j(B,Z),X(Z)}else O.has("data")&&j(Rh(t,u.scene).verdicts,Z);v.draw(u.t),I.place(u.t),L.update()}function j(O,Z){let B=u.cards.filter(({name:ot})=>u.laws.includes(ot)),et=op(t,u.scene,B.map(({name:ot})=>ot)),it=ap(u.scene,u.ball);R.update(B.map(({name:ot,dashes:rt})=>({name:ot,colour:Z.get(ot)??"#888",dashes:rt,width:ot===u.followed?2.4:1.6,points:et.get(ot)??[]})),u.rebounds,it,B.flatMap(({name:ot})=>{let rt=O.get(ot)?.angle;return typeof rt=="number"?[{colour:Z.get(ot)??"#888",y:rt}]:[]})),Zt("measured").textContent=u.rebounds.length?`${u.rebounds.length} from ${u.reboundsFrom}`:"drop a CSV table anywhere on the page"}function X(O){let Z=[],B=[];for(let{name:et,dashes:it}of u.cards){let ot=d.runs.get(et);if(!ot)continue;let rt={name:et,colour:O.get(et)??"#888",dashes:it,width:et===u.followed?2.2:1.5},Mt=Ud(ot,u.ball,g,60),Wt=gh(u.scene,ot,0),At=u.scene.floor?u.scene.balls[u.ball].radius:0;Wt>0&&Z.push({...rt,points:Mt.map(Dt=>[Dt,gh(u.scene,ot,Dt)/Wt])}),B.push({...rt,points:Mt.map(Dt=>[Dt,(ai(ot.balls[u.ball].pieces,Dt).x[2]-At)*1e3])})}I.update(Z,B,g)}let Y=Zt("preset");Y.append(...n.presets.map(({title:O},Z)=>Jt("option",{value:String(Z)},O))),Y.value=String(i);let st=O=>Zt("about").textContent=O;return st(o?"":s.about),Y.onchange=()=>{let O=n.presets[Number(Y.value)];h.remember(),ei(""),st(O.about),Object.assign(u,{ball:0,wall:-1,t:O.time??0,speed:O.slow??1,playing:!1}),h.change({scene:zs(t,O.scene),laws:r.filter(Z=>O.laws.includes(Z)),followed:O.scene.run.law},"scene","laws","time"),_=jo(u.scene,d.runs,u.followed,g),V(new Set(["scene"])),v.look(O.view??"free")},Zt("undo").onclick=()=>h.undo(),Zt("redo").onclick=()=>h.redo(),Zt("theme").onclick=()=>{let O=document.documentElement;O.dataset.theme=O.dataset.theme==="dark"?"light":"dark",V(new Set(["scene"]))},addEventListener("keydown",O=>{!(O.ctrlKey||O.metaKey)||O.key.toLowerCase()!=="z"||(O.preventDefault(),O.shiftKey?h.redo():h.undo())}),addEventListener("hashchange",()=>{try{let O=Nh(location.hash,t,r);if(!O)return;let Z=Vs(t,O.scene,O.laws.length?O.laws:[O.scene.run.law]).fault;if(Z!==null)throw new Error(Z);h.remember(),h.change({...O,ball:0,wall:-1,playing:!1},"scene","laws","time"),_=jo(u.scene,d.runs,u.followed,g),V(new Set(["scene"]))}catch(O){ei(li(O))}}),new ResizeObserver(()=>{v.resize(),V(new Set(["scene"]))}).observe(y),V(new Set(["scene"])),v.look(o?"free":s.view??"free"),performance.mark("ready"),document.documentElement.dataset.ready="true",h}EE().catch(n=>{ei(li(n)),document.documentElement.dataset.ready="failed"});})();
